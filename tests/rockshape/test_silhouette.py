import numpy as np
import pytest

from rockshape.camera.camera import Camera
from rockshape.camera.silhouette import grazing_rays

CAMERA = Camera(fx=100.0, fy=100.0, cx=9.5, cy=9.5, width=20, height=20)


def test_rays_pass_between_the_pixels_of_a_box() -> None:
    rays = grazing_rays(np.ones((2, 3), dtype=bool), (4, 6), CAMERA)
    pixels = rays[:, :2] * 100 + 9.5
    assert len(rays) == 2 * (2 + 3)
    assert {(5.5, 4.0), (5.5, 5.0), (8.5, 4.0), (8.5, 5.0)} <= set(map(tuple, pixels.round(6)))
    assert {(6.0, 3.5), (7.0, 5.5)} <= set(map(tuple, pixels.round(6)))
    assert np.all(rays[:, 2] == 1)


def test_the_border_of_the_frame_is_no_outline() -> None:
    rays = grazing_rays(np.ones((2, 3), dtype=bool), (0, 17), CAMERA)
    # of the box's ten sides the three above and the two to the right are the frame's
    assert len(rays) == 5


@pytest.mark.parametrize(("beside_m", "kept"), [(2.0, False), (2.49, True), (3.0, True)])
def test_what_stands_in_front_cuts_the_outline(beside_m: float, kept: bool) -> None:
    mask = np.zeros((5, 6), dtype=bool)
    mask[:, :5] = True
    grid = np.full((5, 6, 3), [0.0, 0.0, 2.5])
    grid[:, 5, 2] = beside_m
    rays = grazing_rays(mask, (4, 6), CAMERA, grid)
    right = rays[rays[:, 0] > (10.4 - 9.5) / 100]
    assert (len(right) > 0) == kept
    assert len(rays) == (20 if kept else 15)
