"""The parts of the smooth ground: what lies gently below heights, and what bends least."""

import numpy as np
import pytest

from rockshape.ground import NoiseModel, Plane
from rockshape.ground.slope_filter import gentle_below
from rockshape.ground.thin_plate import bend
from rockshape.ground.undulation import Swell, fit_swell, undulates

NORMAL = np.array([0.0, -1.0, 0.0])


def test_what_is_gentle_is_its_own_envelope() -> None:
    y, x = np.mgrid[:60, :80]
    waves = 0.3 * np.sin(x / 4.0) + 0.1 * np.cos(y / 3.0)  # rises by 0.075 and 0.034 a cell at most
    assert np.array_equal(gentle_below(waves, np.array(0.08)), waves)


def test_a_block_rises_above_its_envelope_but_for_what_may_rise_from_its_sides() -> None:
    heights = np.zeros((41, 41))
    heights[16:25, 16:25] = 3.0
    below = gentle_below(heights, np.array(0.5))
    assert (below[heights == 0] == 0).all()
    # the middle is five cells from the ground
    assert below[20, 20] == pytest.approx(2.5)
    assert (below[16, 16:25] == 0.5).all()


def test_the_envelope_is_below_gentle_and_the_highest_such(rng: np.random.Generator) -> None:
    heights = rng.random((30, 30))
    heights[5:9, 5:20] = np.inf
    below = gentle_below(heights, np.array(0.1))
    assert (below <= heights).all()
    assert np.abs(np.diff(below, axis=0)).max() <= 0.1 + 1e-12
    assert np.abs(np.diff(below, axis=1)).max() <= 0.1 + 1e-12
    assert np.array_equal(gentle_below(below, np.array(0.1)), below)


@pytest.mark.parametrize("shape", [(30, 50), (50, 30)])
def test_a_slope_is_continued_below_what_is_missing(shape: tuple[int, int]) -> None:
    y, x = np.mgrid[: shape[0], : shape[1]]
    plane = (0.02 * x - 0.01 * y).astype(np.float32)
    weight = np.ones(shape, dtype=np.float32)
    weight[10:18, 10:18] = 0
    surface = bend(np.where(weight > 0, plane, 9).astype(np.float32), weight, stiff=0.2, taut=0)
    # single precision, and the least weight that holds what is missing to 0
    assert np.abs(surface - plane).max() < 5e-3


def test_the_surface_is_the_best_of_its_neighbours(rng: np.random.Generator) -> None:
    value, weight = rng.random((2, 8, 9)).astype(np.float32)

    def cost(s: np.ndarray) -> float:
        second = [np.diff(s, 2, axis=axis) for axis in (0, 1)]
        first = [np.diff(s, axis=axis) for axis in (0, 1)]
        twist = np.diff(np.diff(s, axis=0), axis=1)
        bending = sum(float((part**2).sum()) for part in second) + 2 * float((twist**2).sum())
        rise = sum(float((part**2).sum()) for part in first)
        return float((weight * (value - s) ** 2).sum()) + 0.3 * bending + 0.1 * rise

    best = bend(value, weight, stiff=0.3, taut=0.1).astype(np.float64)
    for _ in range(20):
        step = 0.02 * rng.standard_normal(best.shape)
        # a quadratic: the change by a step is that by the reverse step, at the bottom
        assert cost(best + step) == pytest.approx(cost(best - step), rel=2e-3)
        assert cost(best + step) > cost(best)


def test_straight_down_there_is_no_azimuth_and_few_points_are_no_surface(
    rng: np.random.Generator,
) -> None:
    points = rng.random((500, 3)) + np.array([0, 1, 2])
    noise = NoiseModel(0.0, 1, 0.0, 1e-3)
    down = Plane(np.array([0.0, 0.0, -1.0]), offset_m=-3.0, sigma_m=0.0, accepted=1.0)
    level = Plane(NORMAL, offset_m=-2.0, sigma_m=0.0, accepted=1.0)
    assert not undulates(points, plane=down, noise=noise)
    assert fit_swell(points, plane=down, noise=noise) is None
    assert fit_swell(points[:50], plane=level, noise=noise) is None
    assert fit_swell(points, plane=level, noise=noise) is None


def test_the_surface_is_linear_between_its_nodes_at_any_place() -> None:
    axes = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    azimuth, distance = np.mgrid[:11, :21]
    nodes = (0.3 * azimuth + 0.2 * distance).astype(np.float32)
    swell = Swell(axes, np.zeros(2), 0.1, nodes, 0.0)
    where = np.linspace(0.01, 9.99, 500)  # cells; closer than a 32nd of one
    turn, far = 0.1 * where, np.exp(0.2 * where[::-1])
    points = np.column_stack([far * np.sin(turn), np.zeros(500), far * np.cos(turn)])
    # places are in single precision
    assert swell.height_m(points) == pytest.approx(0.3 * where + 0.4 * where[::-1], abs=1e-4)
