"""The edge of pixels, and outlines resampled and smoothed along their length."""

import numpy as np
import pytest
from scipy.ndimage import binary_fill_holes, label
from skimage.measure import find_contours

from rockshape.outline.edge import edge_of, trace_edge
from rockshape.outline.resample import (
    canonical,
    even_outline,
    outline_length,
    pixel_smooth,
    smooth_evenly,
)
from rockshape.outline.trace import signed_area, trace_outline
from tests import solids


def as_set(points: np.ndarray) -> set[tuple[float, ...]]:
    return set(map(tuple, points.tolist()))


def blobs(rng: np.random.Generator) -> np.ndarray:
    """The largest part, holes and spikes with it, of random pixels."""
    parts, _ = label(rng.random((24, 24)) < 0.62, structure=np.ones((3, 3)))
    return parts == 1 + np.argmax(np.bincount(parts.ravel())[1:])


def test_the_edge_is_the_half_level_of_marching_squares(rng: np.random.Generator) -> None:
    for _ in range(40):
        mask = np.pad(binary_fill_holes(blobs(rng), structure=np.ones((3, 3))), 1)
        # with diagonal pixels joined scikit-image's contours are the same points, closed
        contours = find_contours(mask.astype(float), 0.5, fully_connected="high")
        longest = max(contours, key=len)[:-1, ::-1]
        edge = trace_edge(mask)
        assert len(edge) == len(longest)
        assert as_set(edge) == as_set(longest)


def test_the_edge_encloses_the_pixels_but_for_half_a_pixel(rng: np.random.Generator) -> None:
    for _ in range(20):
        # by sides, so that no part hangs by a corner, where the polygon would touch itself
        parts, _ = label(rng.random((30, 30)) < 0.7)
        mask = binary_fill_holes(parts == 1 + np.argmax(np.bincount(parts.ravel())[1:]))
        mask = binary_fill_holes(np.pad(mask, 1), structure=np.ones((3, 3)))
        assert signed_area(trace_edge(mask)) <= mask.sum() - 0.5 + 1e-9
    disc = solids.disc(20, shift=(0.2, 0.1))
    assert signed_area(trace_edge(disc)) == disc.sum() - 0.5


@pytest.mark.parametrize("direction", [1, -1])
@pytest.mark.parametrize("start", [0, 5])
def test_the_edge_does_not_ask_how_the_outline_was_traced(direction: int, start: int) -> None:
    outline = trace_outline(solids.ellipse(12, 7, turn_rad=0.5))
    other = edge_of(np.roll(outline, start, axis=0)[::direction])
    assert as_set(other) == as_set(edge_of(outline))
    assert signed_area(other) == signed_area(edge_of(outline)) > 0


def test_one_pixel_has_four_sides_and_none_has_none() -> None:
    mask = np.zeros((3, 3), dtype=bool)
    assert trace_edge(mask).shape == (0, 2)
    mask[1, 1] = True
    assert as_set(trace_edge(mask)) == {(1.5, 1.0), (0.5, 1.0), (1.0, 1.5), (1.0, 0.5)}


def test_a_line_of_pixels_has_both_its_sides() -> None:
    mask = np.zeros((3, 7), dtype=bool)
    mask[1, 1:6] = True
    assert len(trace_edge(mask)) == 12
    assert signed_area(trace_edge(mask)) == 4.5


def test_even_points_lie_a_step_apart_on_the_outline() -> None:
    square = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])
    assert even_outline(square, 16) == pytest.approx(
        solids.regular_polygon(4, 1, points=16) * 0
        + np.array([*[(x, 0) for x in range(4)], *[(4, y) for y in range(4)],
                    *[(4 - x, 4) for x in range(4)], *[(0, 4 - y) for y in range(4)]])
    )  # fmt: skip
    assert even_outline(np.ones((5, 2)), 9).shape == (0, 2)


def test_smoothing_shrinks_a_circle_by_the_fourth_power() -> None:
    radius, sigma = 20.0, 4.0
    smooth = smooth_evenly(solids.circle(radius, points=2000), sigma=sigma, count=500)
    # 1 - (1 - g)² with g = exp(-x), x = sigma²/(2R²)
    gauss = np.exp(-((sigma / radius) ** 2) / 2)
    expected = radius * gauss * (2 - gauss)
    assert np.hypot(*smooth.T) == pytest.approx(expected, rel=1e-4)  # chords of 500 sides
    assert radius - expected == pytest.approx(sigma**4 / (4 * radius**3), rel=0.05)


def test_smoothing_takes_the_staircase_and_leaves_the_form() -> None:
    edge = trace_edge(solids.disc(40, shift=(0.3, 0.4)))
    length = 2 * np.pi * 40
    # a staircase is longer than its line by 4/pi; between its sides' middles by 5.5 % on average
    assert outline_length(edge) == pytest.approx(1.055 * length, rel=0.005)
    assert outline_length(pixel_smooth(edge)) == pytest.approx(length, rel=0.009)


def test_the_canonical_start_turns_with_the_outline() -> None:
    outline = solids.ellipse(20, 11, turn_rad=0.3, shift=(0.1, 0.4))
    edge = canonical(trace_edge(outline))
    turned = canonical(trace_edge(np.rot90(outline)))
    side = len(outline) - 1
    assert turned == pytest.approx(np.column_stack([edge[:, 1], side - edge[:, 0]]))
