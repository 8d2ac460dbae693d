"""The smallest box against boxes and balls of known sides, and against a search of its own."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rockshape.body import box_half_axes_m

SIDES = np.array([0.3, 0.2, 0.12])
CORNERS = np.stack(np.meshgrid(*[[-1.0, 1.0]] * 3), axis=-1).reshape(-1, 3)


@pytest.mark.parametrize("seed", range(4))
def test_a_turned_box_has_its_own_sides(seed: int) -> None:
    turn = Rotation.random(random_state=seed).as_matrix()
    found = box_half_axes_m((CORNERS * SIDES) @ turn.T + [1.0, 2.0, 5.0])
    assert found == pytest.approx(SIDES, rel=2e-3)


def test_an_ellipsoid_has_its_axes(rng: np.random.Generator) -> None:
    sphere = rng.standard_normal((4000, 3))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    turn = Rotation.random(random_state=3).as_matrix()
    assert box_half_axes_m((sphere * SIDES) @ turn.T) == pytest.approx(SIDES, rel=0.03)


def test_no_box_of_a_thousand_turns_is_smaller_by_a_fiftieth(rng: np.random.Generator) -> None:
    points = rng.standard_normal((40, 3)) * SIDES
    turns = Rotation.random(1000, random_state=1).as_matrix()
    least = np.ptp(points @ turns.transpose(0, 2, 1), axis=1).prod(axis=1).min()
    found = box_half_axes_m(points)
    assert found is not None
    assert 8 * found.prod() <= 1.02 * least


def test_flat_points_have_none() -> None:
    assert box_half_axes_m(CORNERS * [1.0, 1.0, 0.0]) is None
    assert box_half_axes_m(CORNERS[:3]) is None
