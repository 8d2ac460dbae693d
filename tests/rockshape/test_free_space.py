"""Where a camera has seen past a rock."""

import numpy as np

from rockshape.camera.camera import Camera
from rockshape.camera.free_space import seen_past

CAMERA = Camera(fx=100.0, fy=100.0, cx=49.5, cy=39.5, width=100, height=80)


def at(col: float, row: float, depth_m: float) -> np.ndarray:
    return depth_m * np.array([(col - 49.5) / 100, (row - 39.5) / 100, 1.0])


def test_beside_the_rock_behind_it_and_behind_another() -> None:
    mask = np.zeros((20, 30), dtype=bool)
    mask[5:15, 5:20] = True
    grid = CAMERA.unproject(np.full(CAMERA.shape, 3.0))[30:50, 40:70]
    grid[:, 25:] *= 0.5  # a nearer rock at the right
    points = np.array(
        [
            at(50, 40, 2.5),  # within the mask
            at(50, 40, 9.0),  # the same, far behind
            at(60, 40, 2.5),  # on the pixel beside its edge, col 59
            at(62, 40, 2.5),  # beside it, before the ground
            at(67, 40, 2.5),  # behind the other rock
            at(67, 40, 1.2),  # before it
            at(20, 10, 2.5),  # off the window, in the frame
            at(-5, 40, 2.5),  # out of the frame
        ]
    )
    expected = [False, False, False, True, False, True, True, False]
    assert seen_past(points, mask, (30, 40), CAMERA, grid).tolist() == expected
