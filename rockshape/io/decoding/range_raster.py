"""Range rasters: the points that a range file's values stand for."""

import numpy as np

from rockshape.camera.lens import Lens
from rockshape.errors import InputError, unknown_name
from rockshape.io.format import ImageInfo, RangeRaster
from rockshape.point_grid.points import PointReading, points_from
from rockshape.point_grid.range_kinds import KINDS, QUANTITIES, UNNAMED, RangeKind
from rockshape.point_grid.units import RangeScale, parse_unit


def points_of(
    raster: RangeRaster,
    info: ImageInfo,
    *,
    camera: Lens | None,
    kind: RangeKind | None = None,
    unit: str | None = None,
) -> PointReading:
    """Points of a raster, of a kind and in a unit if not those that the file itself tells.

    Raises: InputError where the raster is not of the image's shape or of the kind, and what
    `points_from` refuses.
    """
    values = raster.values
    if values.ndim == 3 and values.shape[2] == 1:
        values = values[..., 0]
    if values.shape not in (info.shape, (*info.shape, 3)):
        raise InputError(
            f"expected {info.shape} or {(*info.shape, 3)} as the image has, found {values.shape}"
        )
    if camera is not None and camera.shape != info.shape:
        raise InputError(f"camera: expected {info.shape} as the image has, found {camera.shape}")
    if values.dtype.kind not in "fiu":
        raise InputError(f"expected numbers, found {values.dtype}")
    kind = _kind(raster, values.shape[2:], kind)
    return points_from(
        values,
        kind=kind,
        camera=camera,
        scale=_scale(raster, kind, camera, unit),
        no_data=raster.no_data,
    )


def _kind(raster: RangeRaster, pixel_shape: tuple[int, ...], asked: RangeKind | None) -> RangeKind:
    if asked is not None and asked not in KINDS:
        raise unknown_name("range_kind (--range-kind)", asked, KINDS)
    chosen = asked or raster.kind or UNNAMED[pixel_shape]
    needed = QUANTITIES[chosen].pixel_shape
    if pixel_shape != needed:
        words = "three values a pixel" if needed else "one value a pixel"
        raise InputError(f"--range-kind {chosen}: expected {words}, found {raster.values.shape}")
    return chosen


def _scale(
    raster: RangeRaster, kind: RangeKind, camera: Lens | None, unit: str | None
) -> RangeScale:
    """Scale of the values; a whole number is a count of steps, whatever the file type."""
    if unit is not None:
        return parse_unit(unit)
    if not QUANTITIES[kind].is_length:  # in px, the baseline in metres
        return RangeScale()
    if raster.unit == "m" and not np.issubdtype(raster.values.dtype, np.integer):
        return RangeScale()
    if camera is None or camera.depth_scale is None:
        needed = "depth_scale, mm a step, or depth_scale_m, metres a step, in the camera file"
        if camera is None:
            needed = "a camera with depth_scale (camera, --camera)"
        raise InputError(
            f"range in whole steps: expected {needed}, or a unit (range_unit, --range-unit mm), "
            "found none"
        )
    return RangeScale(camera.depth_scale / 1000, f"depth_scale {camera.depth_scale:g} mm")
