"""Readers of each kind of file, through the format registry.

All raise InputError, in one line that names the file, for what cannot be used.
"""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.camera.lens import Lens, as_lens
from rockshape.errors import InputError
from rockshape.io.decoding.range_raster import points_of
from rockshape.io.files import MAX_PIXELS
from rockshape.io.format import ImageContent, ImageInfo
from rockshape.io.guard import guard
from rockshape.io.pixels import to_grey, to_levels, to_unit
from rockshape.io.registry import CAMERAS, IMAGES, LABELS, RANGES
from rockshape.point_grid.points import PointReading
from rockshape.point_grid.range_kinds import RangeKind
from rockshape.point_grid.units import RangeScale, parse_unit
from rockshape.rock.instances import Instances
from rockshape.rock.pieces import Pieces
from rockshape.stereo.pair_range import points_of_pair


def read_picture(path: Path | str, *, max_pixels: int = MAX_PIXELS) -> ImageContent:
    """Pixels of an image, turned as its orientation tag says, and its pixel size if it tells that.

    Pixels are of 8 or 16 bits, or floats from 0 to 1; see `rockshape.io.pixels.to_levels`.
    Raises: InputError for anything but a whole image of at most max_pixels.
    """
    with IMAGES.open(path, max_pixels=max_pixels) as (file, chosen):
        content = chosen.read(file)
        picture = content if isinstance(content, ImageContent) else ImageContent(content)
        if picture.pixels.ndim not in (2, 3) or not picture.pixels.size:
            raise file.refusal(f"pixels of the shape {picture.pixels.shape}")
        return replace(picture, pixels=np.ascontiguousarray(to_levels(picture.pixels)))


def read_pixels(path: Path | str) -> NDArray[Any]:
    """Pixels (rows, cols) or (rows, cols, channels) of an image: those of `read_picture`."""
    return read_picture(path).pixels


def read_image(path: Path | str) -> NDArray[np.float32]:
    """Image (rows, cols) grey or (rows, cols, 3) RGB, from 0 to 1; alpha is dropped.

    Raises: InputError for anything but a whole image.
    """
    return to_unit(read_pixels(path))


def read_labels(
    path: Path | str,
    *,
    shape: tuple[int, ...],
    image_name: str = "",
    pieces: Pieces = "split",
) -> Instances:
    """Rocks outlined in an image of a shape (rows, cols, …): own masks, ids as the file has them.

    path may be a folder of masks. image_name chooses the image in a file of several; pieces tells
    whether a label image with a single value is split into its connected pieces.
    Raises: InputError where the file holds no such labels or those of another shape.
    """
    info = replace(_image_info(shape, image_name), pieces=pieces)
    with LABELS.open(path, image_shape=info.shape) as (file, chosen):
        instances = chosen.read(file, info)
    if instances.shape != info.shape:
        raise InputError(f"{path}: expected {info.shape} as the image has, found {instances.shape}")
    return instances


def read_range(
    path: Path | str,
    *,
    shape: tuple[int, ...],
    camera: Camera | Lens | None,
    kind: RangeKind | None = None,
    unit: str | None = None,
) -> NDArray[np.float64]:
    """Points (rows, cols, 3), m, NaN where nothing was measured: those of `read_points`."""
    return read_points(path, shape=shape, camera=camera, kind=kind, unit=unit).points_m


def read_points(
    path: Path | str,
    *,
    shape: tuple[int, ...],
    camera: Camera | Lens | None,
    kind: RangeKind | None = None,
    unit: str | None = None,
) -> PointReading:
    """Points (rows, cols, 3), m, of a range file, and how many of its values are none.

    - shape: the image's.
    - camera: what took the image; all but points need it, whole numbers need its depth_scale.
    - kind: what the file holds, if not what its format and shape tell.
    - unit: of its numbers, `mm` or `0.25mm` say, in place of metres and of depth_scale.

    Zeros, infinities, saturated steps and no-data constants are no measurement.
    Raises: InputError where the file is no such range or of another shape, and where the median
        range is below 1 cm or above 200 m and no unit is given.
    """
    info = _image_info(shape)
    with RANGES.open(path, image_shape=info.shape) as (file, chosen):
        raster = chosen.read(file, info)
    try:
        return points_of(raster, info, camera=as_lens(camera), kind=kind, unit=unit)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def read_pair(
    path: Path | str,
    *,
    left: NDArray[np.generic],
    camera: Lens | None,
    unit: str | None = None,
    max_pixels: int = MAX_PIXELS,
) -> PointReading:
    """Points (rows, cols, 3), m, at the pixels of a left picture, from the file of the right one.

    - left: pixels of the left picture.
    - camera: what took it, with its baseline or the right camera.
    - unit: of the baseline, `mm` say, in place of metres.

    Raises: InputError where the pictures or the camera are no stereo pair's.
    """
    if camera is None:
        raise InputError("right (--right): expected a stereo camera (--camera), found none")
    right = read_picture(path, max_pixels=max_pixels).pixels
    scale = RangeScale() if unit is None else parse_unit(unit)
    try:
        with guard(_no_pair):
            return points_of_pair(to_grey(left), to_grey(right), camera=camera, scale=scale)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def read_camera(path: Path | str, *, shape: tuple[int, ...] | None = None) -> Camera:
    """Pinhole camera of a file; shape, the image's, stands in where the file tells no size.

    Raises: InputError that names what is missing or wrong, and for a lens that distorts or skews.
    """
    lens = read_lens(path, shape=shape)
    if not lens.is_pinhole:
        raise InputError(
            f"{path}: distortion: expected a pinhole camera, its image, range and labels "
            f"undistorted, found {lens.distortion or f'skew {lens.skew_px:g} px'}"
        )
    return lens.pinhole


def read_lens(
    path: Path | str,
    *,
    shape: tuple[int, ...] | None = None,
    image_name: str = "",
    view: str | None = None,
) -> Lens:
    """Camera of a file with its skew, distortion and pose.

    - shape: the image's, where the file tells no width and height.
    - view: which camera of a file of several; else the one of the image's name.

    Raises: InputError that names what is missing or wrong, and for a camera of another size.
    """
    info = None if shape is None else ImageInfo((shape[0], shape[1]), image_name, view=view)
    with CAMERAS.open(path) as (file, chosen):
        try:
            camera = chosen.read(file, info)
        except InputError as error:
            reason = str(error).removeprefix("camera: ").removeprefix(f"{path}: ")
            raise InputError(f"{path}: {reason}") from None
    lens = Lens(camera) if isinstance(camera, Camera) else camera
    if info is not None and lens.shape != info.shape:
        raise InputError(
            f"{path}: camera: expected {info.shape} as the image has, found {lens.shape}: "
            f"another image's, or of one before it was cropped or scaled"
        )
    return lens


def _no_pair(reason: str) -> InputError:
    return InputError(f"expected the right picture and the camera of a stereo pair, found {reason}")


def _image_info(shape: tuple[int, ...], name: str = "") -> ImageInfo:
    return ImageInfo((shape[0], shape[1]), name)
