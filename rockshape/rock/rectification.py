"""Rectification: an image, its range and its rocks as a pinhole with square pixels sees them."""

from dataclasses import dataclass, replace
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.camera.lens import Lens
from rockshape.errors import InputError
from rockshape.numerics.arrays import Floats, Mask, Singles
from rockshape.rock.instances import Instance, Instances

MAX_SIDE = 2**15 - 1  # px, of what OpenCV resamples
MAX_GROWTH = 4  # of the side of an image, beyond which pixels are too far from square


@dataclass(frozen=True, eq=False)
class PinholeResampling:
    """Resampling of what a lens shows to a pinhole's image with square pixels.

    The greater focal length is kept, so that no detail is lost; skew and distortion are taken out.
    """

    lens: Lens

    def __post_init__(self) -> None:
        rows, cols = self.lens.shape
        if max(rows, cols) > MAX_SIDE or max(self._growth) > MAX_GROWTH:
            raise InputError(
                f"camera: expected square pixels and at most {MAX_SIDE} of them a side, "
                f"found focal lengths {self.lens.pinhole.fx:g} and {self.lens.pinhole.fy:g} px"
            )

    @cached_property
    def camera(self) -> Camera:
        """Pinhole camera with square pixels that the result is seen by."""
        pinhole = self.lens.pinhole
        across, down = self._growth
        focal = max(pinhole.fx, pinhole.fy)
        return replace(
            pinhole,
            fx=focal,
            fy=focal,
            cx=(pinhole.cx + 0.5) * across - 0.5,
            cy=(pinhole.cy + 0.5) * down - 0.5,
            width=round(pinhole.width * across),
            height=round(pinhole.height * down),
        )

    @property
    def _growth(self) -> tuple[float, float]:
        pinhole = self.lens.pinhole
        focal = max(pinhole.fx, pinhole.fy)
        return focal / pinhole.fx, focal / pinhole.fy

    def image(self, pixels: NDArray[np.generic]) -> NDArray[np.generic]:
        """Pixels (rows, cols) or (rows, cols, channels), interpolated; 0 beyond the image."""
        kept = pixels if pixels.dtype.kind == "u" else pixels.astype(np.float32)
        resampled = cv2.remap(
            np.ascontiguousarray(kept), *self._sources, interpolation=cv2.INTER_LINEAR
        )
        return np.asarray(resampled)

    def points(self, points_m: Floats) -> Floats:
        """Points (rows, cols, 3), each pixel's that of its nearest source; NaN beyond the image."""
        x, y = (np.nan_to_num(np.rint(axis), nan=-1).astype(np.intp) for axis in self._sources)
        rows, cols = self.lens.shape
        inside = (x >= 0) & (x < cols) & (y >= 0) & (y < rows)
        resampled = np.full((*self.camera.shape, 3), np.nan)
        resampled[inside] = points_m[y[inside], x[inside]]
        return resampled

    def rocks(self, instances: Instances) -> Instances:
        """Rocks by their own masks, with their ids; one that the result does not show is left out.

        Outlines known to sub-pixel give way to those of the masks.
        """
        moved = (self._rock(instance, instances.shape) for instance in instances)
        return Instances(self.camera.shape, tuple(rock for rock in moved if rock is not None))

    def _rock(self, instance: Instance, shape: tuple[int, int]) -> Instance | None:
        mask = np.zeros(shape, dtype=np.float32)
        mask[instance.window] = instance.mask
        shown: Mask = np.asarray(cv2.remap(mask, *self._sources, cv2.INTER_LINEAR)) >= 0.5
        rows, cols = np.flatnonzero(shown.any(axis=1)), np.flatnonzero(shown.any(axis=0))
        if not len(rows):
            return None
        window = slice(int(rows[0]), int(rows[-1]) + 1), slice(int(cols[0]), int(cols[-1]) + 1)
        return Instance(instance.id, window, shown[window])

    @cached_property
    def _sources(self) -> tuple[Singles, Singles]:
        """Column and row of the lens's image that each pixel of the result shows."""
        rays = self.camera.unproject(np.ones(self.camera.shape))
        x, y = np.moveaxis(self.lens.project(rays), -1, 0).astype(np.float32)
        return np.ascontiguousarray(x), np.ascontiguousarray(y)


def rectification_of(lens: Lens | None) -> PinholeResampling | None:
    """Resampling of what a lens shows; None where pixels are square and nothing is bent."""
    return None if lens is None or lens.has_square_pixels else PinholeResampling(lens)
