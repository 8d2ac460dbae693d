"""Outlines found to sub-pixel are the outlines that are measured."""

import numpy as np
import pytest

import rockshape
from rockshape.rock.view import RockView

COUNT = 300
TURNS = np.linspace(0, 2 * np.pi, COUNT, endpoint=False)


def ellipse(major: float, minor: float, *, turn: float, x: float, y: float) -> np.ndarray:
    u, v = major * np.cos(TURNS), minor * np.sin(TURNS)
    cosine, sine = np.cos(turn), np.sin(turn)
    return np.column_stack([x + u * cosine - v * sine, y + u * sine + v * cosine])


def instances(outline: np.ndarray | None, mask: np.ndarray) -> rockshape.Instances:
    item = rockshape.Instance(4, np.s_[0 : mask.shape[0], 0 : mask.shape[1]], mask, outline)
    return rockshape.Instances(mask.shape, (item,))


def inside(major: float, minor: float, *, turn: float, x: float, y: float) -> np.ndarray:
    rows, cols = np.mgrid[:60, :60]
    dx, dy = cols - x, rows - y
    u = (dx * np.cos(turn) + dy * np.sin(turn)) / major
    v = (dy * np.cos(turn) - dx * np.sin(turn)) / minor
    return u * u + v * v < 1


@pytest.mark.parametrize("turn", [0.0, 0.3, 0.9])
def test_a_small_rocks_axis_ratio_is_its_outlines_and_not_its_pixels(turn: float) -> None:
    shape = {"turn": turn, "x": 30.3, "y": 28.6}
    mask, outline = inside(9.0, 6.0, **shape), ellipse(9.0, 6.0, **shape)
    (fine,) = rockshape.measure(labels=instances(outline, mask), descriptors=True)
    (traced,) = rockshape.measure(labels=instances(None, mask), descriptors=True)
    assert fine.axis_ratio == pytest.approx(2 / 3, abs=1e-3)
    assert abs(fine.axis_ratio - 2 / 3) < abs(traced.axis_ratio - 2 / 3)
    assert fine.sphericity_2d == pytest.approx(2 / 3, abs=0.01)
    assert fine.ellipse_error < 0.2 * traced.ellipse_error
    assert fine.ellipse is not None
    assert (fine.ellipse.x, fine.ellipse.y) == pytest.approx((30.3, 28.6), abs=0.01)
    assert fine.descriptors is not None
    assert fine.descriptors.area == pytest.approx(np.pi * 54, rel=2e-3)


def test_neither_the_paper_nor_a_rock_that_the_frame_cuts_takes_it() -> None:
    shape = {"turn": 0.4, "x": 30.3, "y": 28.6}
    mask, outline = inside(9.0, 6.0, **shape), ellipse(9.0, 6.0, **shape)
    one, other = (
        rockshape.measure(labels=instances(edge, mask), method="paper")[0].values
        for edge in (outline, None)
    )
    assert one == pytest.approx(other, nan_ok=True)
    cut = RockView(mask=mask, frame=(slice(0, 29), slice(0, 60)), subpixel_px=outline)
    whole = RockView(mask=mask, frame=(slice(0, 29), slice(0, 60)))
    assert cut.truncated
    np.testing.assert_array_equal(cut.edge_px, whole.edge_px)


def test_it_is_not_smoothed_by_the_blur_that_a_staircase_asks_for() -> None:
    outline = ellipse(9.0, 6.0, turn=0.2, x=30.0, y=30.0)
    mask = inside(9.0, 6.0, turn=0.2, x=30.0, y=30.0)
    view = RockView(mask=mask, subpixel_px=outline)
    x, y = ((view.smooth_outline_px - (30, 30)) @ np.array([[0.98, -0.199], [0.199, 0.98]])).T
    assert (x / 9.0) ** 2 + (y / 6.0) ** 2 == pytest.approx(1, abs=0.01)
    steps = np.linalg.norm(np.diff(view.smooth_outline_px, axis=0), axis=1)
    assert np.ptp(steps) < 0.01 * steps.mean()


def test_the_outline_shown_is_the_one_measured() -> None:
    rows, cols = np.mgrid[:60, :60]
    mask = np.hypot(cols - 30.3, rows - 28.6) < 9
    outline = ellipse(9.0, 9.0, turn=0.0, x=30.3, y=28.6)

    def radii(edge: np.ndarray | None, method: str = "robust") -> np.ndarray:
        (rock,) = rockshape.measure(labels=instances(edge, mask), method=method)
        assert not rock.outline_px.flags.writeable
        return np.hypot(*(rock.outline_px - (30.3, 28.6)).T)

    assert radii(outline) == pytest.approx(9, abs=0.01)
    assert radii(None) == pytest.approx(9, abs=0.5)
    assert radii(None).mean() == pytest.approx(9, abs=0.1)
    assert radii(outline, "paper").mean() == pytest.approx(8.5, abs=0.15)  # pixels' centres
