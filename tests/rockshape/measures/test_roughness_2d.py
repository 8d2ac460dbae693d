"""2-D roughness against waves of known height, and what must not count."""

import numpy as np
import pytest

import rockshape
from rockshape.measures import ON_DEMAND, ROBUST
from rockshape.measures.roughness_2d import ROBUST as ROUGHNESS
from rockshape.outline.polygon_fill import inside_of
from rockshape.rock.view import RockView

TURN = np.linspace(0, 2 * np.pi, 4000, endpoint=False)


def wavy(radius_px: float, waves: int, height: float) -> np.ndarray:
    """Circle under so many waves, their RMS height over its radius."""
    arm = radius_px * (1 + np.sqrt(2) * height * np.cos(waves * TURN))
    return np.column_stack([arm * np.cos(TURN), arm * np.sin(TURN)]) + radius_px * 1.2


def mask_of(outline: np.ndarray) -> np.ndarray:
    side = int(np.ceil(outline.max())) + 3
    window, inside = inside_of(*outline.T, (side, side))
    mask = np.zeros((side, side), dtype=bool)
    mask[window] = inside
    return mask


def left(waves: int) -> float:
    """Share of a wave's height between the two scales: differences of g (2 - g)."""
    fine, coarse = (np.exp(-((waves * sigma) ** 2) / 2) for sigma in (0.03, 0.08))
    return float(fine * (2 - fine) - coarse * (2 - coarse))


@pytest.mark.parametrize("waves", [24, 33, 45])
def test_waves_have_their_height_times_what_the_scales_leave(waves: int) -> None:
    outline = wavy(400, waves, 0.004)
    expected = 0.004 * left(waves)
    assert expected > 0.002
    assert rockshape.roughness_2d(outline) == pytest.approx(expected, rel=0.04)
    # the way along a staircase is a twentieth longer than along the outline, and so each wave
    assert rockshape.roughness_2d(mask_of(outline)) == pytest.approx(expected, rel=0.12)


def test_the_same_waves_have_the_same_value_at_every_size() -> None:
    values = [rockshape.roughness_2d(mask_of(wavy(radius, 30, 0.006))) for radius in (80, 160, 500)]
    assert values == pytest.approx([values[-1]] * 3, rel=0.1)


def test_higher_waves_have_higher_values() -> None:
    values = [
        rockshape.roughness_2d(mask_of(wavy(120, 30, h))) for h in (0.002, 0.004, 0.008, 0.016)
    ]
    assert np.all(np.diff(values) > 0)
    assert values[3] == pytest.approx(2 * values[2], rel=0.1)


def test_long_waves_are_form() -> None:
    assert rockshape.roughness_2d(wavy(400, 5, 0.02)) < 0.0005


def test_corners_are_no_ripples() -> None:
    square = np.array([[50.0, 50.0], [650.0, 50.0], [650.0, 650.0], [50.0, 650.0]])
    assert rockshape.roughness_2d(square) < 0.0005
    assert rockshape.roughness_2d(mask_of(square)) < 0.0005


@pytest.mark.parametrize(
    ("radius_px", "reason"),
    [(30, rockshape.Reason.TOO_SMALL), (60, rockshape.Reason.NOT_RESOLVABLE), (300, None)],
)
def test_a_disc_is_smooth_only_where_it_has_pixels_enough(radius_px: int, reason: object) -> None:
    reading = rockshape.roughness_2d(mask_of(wavy(radius_px, 3, 0.0)))
    assert reading.reason is reason
    if reason is None:
        assert reading < 0.0004


def test_a_rock_that_the_frame_cuts_is_refused() -> None:
    mask = mask_of(wavy(200, 30, 0.01))
    frame = slice(0, mask.shape[0]), slice(0, mask.shape[1] // 2)
    cut = RockView(mask=mask[:, : mask.shape[1] // 2], frame=frame)
    assert ROUGHNESS.read(cut).reason is rockshape.Reason.TRUNCATED


def test_a_neighbour_makes_no_ripple() -> None:
    outline = wavy(300, 30, 0.004)
    mask = mask_of(outline)
    alone = ROUGHNESS.read(RockView(mask=mask))
    rows = np.arange(mask.shape[0])
    teeth = (140 + 8 * (rows // 20 % 2))[:, None]  # a jagged edge that another rock has made
    hidden = np.arange(mask.shape[1])[None, :] < teeth
    beside = RockView(mask=mask & ~hidden, hidden=np.pad(hidden, 1))
    naked = RockView(mask=mask & ~hidden)
    assert ROUGHNESS.read(beside) == pytest.approx(alone, rel=0.2)
    assert ROUGHNESS.read(naked) > 1.3 * alone


def test_no_table_has_it() -> None:
    assert ROUGHNESS in ON_DEMAND
    assert ROUGHNESS.column not in {measure.column for measure in ROBUST}
