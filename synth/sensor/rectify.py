"""Rectification: straight images of a lens before they are matched, and the way back."""

from dataclasses import replace
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats, Mask
from synth.camera.camera import RenderCamera
from synth.camera.lens import Reals, distorted, undistorted
from synth.camera.projection import border_rays, pixel_rays

Bytes = NDArray[np.uint8]

_STEP_PX = 1.0  # of disparity: neighbours farther apart lie on different surfaces
_HOLE_PX = -1e6  # a disparity that no pixel has
_SAME_RAY = 1e-6  # of x/z: a lens that folds sends a second ray to the same place


class Rectification:
    """Rectification of a camera with a lens to a pinhole whose frame holds all that it sees.

    Both eyes have the same lens, so in two pictures of the pinhole a point lies in the same row
    and its columns differ by the disparity f B/Z.
    """

    def __init__(self, camera: RenderCamera) -> None:
        self.camera = camera
        across, down = np.concatenate(border_rays(camera)).T
        column, row = camera.cx + camera.fx * across, camera.cy + camera.fy * down
        first_column, first_row = int(np.floor(column.min())), int(np.floor(row.min()))
        self.pinhole = replace(
            camera,
            distortion=None,
            cx=camera.cx - first_column,
            cy=camera.cy - first_row,
            width=int(np.ceil(column.max())) - first_column + 1,
            height=int(np.ceil(row.max())) - first_row + 1,
        )
        rays = np.broadcast_arrays(*pixel_rays(self.pinhole))
        bent = distorted(camera, *rays)
        self._column, self._row = _places(camera, *bent)
        own = np.hypot(*np.subtract(undistorted(camera, *bent), rays)) < _SAME_RAY
        own &= np.abs(self._column - (camera.width - 1) / 2.0) <= camera.width / 2.0
        own &= np.abs(self._row - (camera.height - 1) / 2.0) <= camera.height / 2.0
        self.seen: Mask = own
        self._back = _places(self.pinhole, *undistorted(camera, *pixel_rays(camera)))

    def straight_picture(self, picture: Bytes) -> Bytes:
        """Picture, (rows, cols), as the pinhole takes it.

        Where nothing is seen the frame's border is repeated: a black frame would be matched.
        """
        found = cv2.remap(
            picture, self._column, self._row, cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE
        )
        return np.asarray(found, dtype=np.uint8)

    def straight_disparity_px(self, disparity_px: Floats) -> Floats:
        """Lens's disparities at the pinhole's pixels, (rows, cols); NaN where unseen."""
        found = _looked_up(disparity_px, self._column, self._row)
        return np.where(self.seen, found, np.nan)

    def bent_disparity_px(self, disparity_px: Floats) -> Floats:
        """Pinhole's disparities, (rows, cols), at the lens's pixels."""
        return _looked_up(disparity_px, *self._back)

    def bent_mask(self, mask: Mask) -> Mask:
        """Mask of the pinhole's pixels at the lens's, the nearest one's."""
        found = cv2.remap(mask.astype(np.uint8), *self._back, cv2.INTER_NEAREST)
        return np.asarray(found > 0)

    def outside_right(self, disparity_px: Floats) -> Mask:
        """Mask of the pinhole's pixels that the right lens's frame does not hold."""
        column = np.arange(disparity_px.shape[1]) - np.nan_to_num(disparity_px)
        landing = np.rint(column).astype(np.int64)
        clipped = np.clip(landing, 0, disparity_px.shape[1] - 1)
        return np.asarray((clipped != landing) | ~np.take_along_axis(self.seen, clipped, axis=1))


@lru_cache(maxsize=1)
def rectification_of(camera: RenderCamera) -> Rectification:
    """Camera's rectification; the last one is kept, since all views have one camera."""
    return Rectification(camera)


def _places(
    camera: RenderCamera, across: Reals, down: Reals
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Columns and rows of rays that the lens has bent already, as cv2.remap takes them."""
    across, down = np.broadcast_arrays(across, down)
    column, row = camera.cx + camera.fx * across, camera.cy + camera.fy * down
    return column.astype(np.float32), row.astype(np.float32)


def _looked_up(
    disparity_px: Floats, column: NDArray[np.float32], row: NDArray[np.float32]
) -> Floats:
    """Disparities between pixels: linear on a surface, the nearest at edges and holes."""
    values = disparity_px.astype(np.float32)
    known = np.nan_to_num(values, nan=_HOLE_PX)
    box = np.ones((3, 3), dtype=np.uint8)
    surface = (cv2.dilate(known, box) - cv2.erode(known, box) < _STEP_PX).astype(np.uint8)
    nearest, linear, smooth = (
        cv2.remap(one, column, row, kind, borderMode=cv2.BORDER_REPLICATE)
        for one, kind in (
            (values, cv2.INTER_NEAREST),
            (values, cv2.INTER_LINEAR),
            (surface, cv2.INTER_NEAREST),
        )
    )
    return np.where(smooth > 0, linear, nearest).astype(np.float64)
