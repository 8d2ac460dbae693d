import numpy as np
import pytest

from rockshape.camera.posed_projection import derivatives, posed, projected

POINTS = np.array([[0.3, -0.2, 2.0], [-1.0, 0.4, 3.0], [0.5, 0.8, 5.0], [0.1, 0.1, 1.0]])
TURNS = [
    pytest.param([0.0, 0.0, 0.0], id="no turn"),
    pytest.param([3e-5, -2e-5, 4e-5], id="a small one"),
    pytest.param([0.3, -0.2, 0.1], id="a turn"),
    pytest.param([0.0, 0.0, 3.1], id="nearly half a turn"),
]


@pytest.mark.parametrize("turn", TURNS)
def test_derivatives_are_those_of_central_differences(turn: list[float]) -> None:
    parameters = np.array([*turn, 0.1, -0.3, 4.0, 6.2])
    assert (posed(parameters, POINTS)[:, 2] > 0).all()
    step = 1e-6
    differences = [
        (projected(parameters + each, POINTS) - projected(parameters - each, POINTS)) / (2 * step)
        for each in step * np.eye(7)
    ]
    found = derivatives(parameters, POINTS)
    assert found == pytest.approx(np.stack(differences, axis=-1), rel=1e-6, abs=1e-4)


@pytest.mark.parametrize("back_m", [10.0, 1.0])
def test_points_behind_a_camera_or_in_it_do_not_move_with_their_depth(back_m: float) -> None:
    parameters = np.array([0.0, 0.0, 0.0, 0.0, 0.0, -back_m, 6.2])
    points = POINTS[POINTS[:, 2] <= back_m]
    found = derivatives(parameters, points)
    assert (found[:, :, 5] == 0).all()
    assert np.isfinite(found).all()


def test_a_point_is_seen_where_its_ray_meets_the_image() -> None:
    quarter_turn = np.array([0.0, 0.0, np.pi / 2, 0.0, 0.0, 1.0, np.log(500.0)])
    assert projected(quarter_turn, np.array([[0.3, -0.2, 1.0]])) == pytest.approx(
        np.array([[50.0, 75.0]])
    )
