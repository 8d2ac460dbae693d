"""Free space of a rock's picture: places that the camera has seen past."""

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera

EDGE_PX = 1  # of the mask, which may be the rock's or what is beside it


def seen_past(
    points_m: NDArray[np.float64],
    mask: NDArray[np.bool_],
    corner: tuple[int, int],
    camera: Camera,
    grid_m: NDArray[np.float64],
) -> NDArray[np.bool_]:
    """Whether nothing of the rock can be at points (n, 3): the camera sees past it there.

    That is so where a point's pixel is in the frame and more than a pixel off the mask (rows, cols)
    and nothing measured there, grid_m (rows, cols, 3), is nearer than the point. corner is the row
    and column of the mask's first pixel in the image.
    """
    place = np.rint(camera.project(points_m)[:, ::-1]).astype(int)
    framed = ((place >= 0) & (place < camera.shape)).all(axis=1)
    side = 2 * EDGE_PX + 1
    rock = cv2.dilate(np.pad(mask, EDGE_PX).view(np.uint8), np.ones((side, side), np.uint8))
    place -= np.array(corner)
    inside = _at(rock.astype(np.float64), place + EDGE_PX, outside=0.0) > 0
    nearest = _at(np.where(mask, np.nan, grid_m[..., 2]), place, outside=np.nan)
    return np.asarray(framed & ~inside & ~(nearest < points_m[:, 2]))


def _at(
    image: NDArray[np.float64], place: NDArray[np.intp], *, outside: float
) -> NDArray[np.float64]:
    """Values (n,) of an image (rows, cols) at places (n, 2), row and column; `outside` off it."""
    within = ((place >= 0) & (place < image.shape)).all(axis=1)
    values = np.full(len(place), outside)
    values[within] = image[tuple(place[within].T)]
    return values
