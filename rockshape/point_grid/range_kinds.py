"""Range kinds: what a range value may stand for, and the points that follow from it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.lens import Lens
from rockshape.errors import InputError
from rockshape.numerics.arrays import Floats
from rockshape.point_grid.missing import missing_in_points, missing_in_raster
from rockshape.point_grid.units import RangeScale

RangeKind = Literal["depth", "distance", "disparity", "xyz"]
KINDS: tuple[RangeKind, ...] = get_args(RangeKind)


@dataclass(frozen=True, eq=False)
class KnownRange:
    """Range values of an image, NaN where nothing was measured, with what they are read by."""

    values: Floats  # (rows, cols) or (rows, cols, 3)
    whole: bool  # given as whole numbers
    camera: Lens | None  # what took the image
    scale: RangeScale

    def rays(self, title: str) -> Floats:
        """Rays of the pixels with z = 1, (rows, cols, 3).

        Raises: InputError without a camera, about values of this title.
        """
        if self.camera is None:
            raise InputError(
                f"{title}: expected a camera (camera, --camera) to turn it into points, found none"
            )
        return self.camera.rays()


@dataclass(frozen=True)
class RangeQuantity:
    """Kind of range: how its values are read."""

    to_points: Callable[[KnownRange], Floats]  # (rows, cols, 3), m
    pixel_shape: tuple[int, ...] = ()  # of the values of one pixel
    find_missing: Callable[..., dict[str, NDArray[np.bool_]]] = missing_in_raster
    is_length: bool = True  # or else px
    is_in_frame: bool = False  # coordinates, in a frame that may not be the camera's


def _from_depth(known: KnownRange) -> Floats:
    depth_m = known.values * known.scale.metres
    return np.asarray(known.rays("z-depth") * depth_m[..., None])


def _from_distance(known: KnownRange) -> Floats:
    rays = known.rays("distance")
    depth_m = known.values * known.scale.metres / np.sqrt((rays**2).sum(axis=-1))
    return np.asarray(rays * depth_m[..., None])


def _from_disparity(known: KnownRange) -> Floats:
    """Points of disparity in px or steps; the scale's unit is the baseline's.

    Raises: InputError for a camera without baseline, and one that is no pinhole.
    """
    disparity = known.values * _step_px(known)
    rays = known.rays("disparity")
    camera = known.camera
    if camera is None or camera.disparity is None:
        raise InputError(
            "disparity: expected a baseline in the camera file (baseline_m, Q or the like), "
            "found none"
        )
    if not camera.is_pinhole:
        raise InputError(
            "disparity: expected the camera of rectified images, found one with distortion or skew"
        )
    depth = camera.disparity.depth(disparity, fx=camera.pinhole.fx)
    return np.asarray(rays * depth[..., None] * known.scale.metres)


def _step_px(known: KnownRange) -> float:
    """Pixels of disparity in one of its values."""
    camera = known.camera
    if camera is None or camera.disparity is None or not known.whole:
        return 1.0
    if camera.disparity.step_px is None:
        raise InputError(
            "disparity in whole steps: expected disparity_scale, px a step, in the camera file "
            "(0.0625 of OpenCV's matchers, 0.00390625 of KITTI), found none"
        )
    return camera.disparity.step_px


def _from_points(known: KnownRange) -> Floats:
    return known.values * known.scale.metres


QUANTITIES: Mapping[RangeKind, RangeQuantity] = {
    "depth": RangeQuantity(_from_depth),
    "distance": RangeQuantity(_from_distance),
    "disparity": RangeQuantity(_from_disparity, is_length=False),
    "xyz": RangeQuantity(
        _from_points, pixel_shape=(3,), find_missing=missing_in_points, is_in_frame=True
    ),
}
# What range is of that does not say so, by the shape of the values of one pixel.
UNNAMED: Mapping[tuple[int, ...], RangeKind] = {(): "depth", (3,): "xyz"}
