"""Readers of each kind of file, through the format registry.

All raise InputError, in one line that names the file, for what cannot be used.
"""

from pathlib import Path
from typing import cast

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.errors import InputError
from rockshape.io.format import ImageInfo, RangeRaster
from rockshape.io.pixels import to_unit
from rockshape.io.registry import CAMERAS, IMAGES, LABELS, RANGES
from rockshape.rock.instances import Instances


def read_pixels(path: Path | str) -> NDArray[np.uint8] | NDArray[np.uint16]:
    """Pixels (rows, cols) or (rows, cols, channels) of an image as they are stored.

    Raises: InputError for anything but a whole image of 8 or 16 bits a channel.
    """
    with IMAGES.open(path) as (file, chosen):
        pixels = chosen.read(file)
    if pixels.dtype not in (np.uint8, np.uint16):
        raise InputError(f"{path}: expected 8 or 16 bits a channel, found {pixels.dtype}")
    return cast("NDArray[np.uint8] | NDArray[np.uint16]", pixels)


def read_image(path: Path | str) -> NDArray[np.float32]:
    """Image (rows, cols) grey or (rows, cols, 3) RGB, from 0 to 1; alpha is dropped.

    Raises: InputError for anything but a whole image of 8 or 16 bits a channel.
    """
    return to_unit(read_pixels(path))


def read_labels(path: Path | str, *, shape: tuple[int, ...], image_name: str = "") -> Instances:
    """Rocks outlined in an image of a shape (rows, cols, …): own masks, ids as the file has them.

    image_name chooses the image in a file of several.
    Raises: InputError where the file holds no such labels or those of another shape.
    """
    info = _image_info(shape, image_name)
    with LABELS.open(path, image_shape=info.shape) as (file, chosen):
        instances = chosen.read(file, info)
    if instances.shape != info.shape:
        raise InputError(f"{path}: expected {info.shape} as the image has, found {instances.shape}")
    return instances


def read_range(
    path: Path | str, *, shape: tuple[int, ...], camera: Camera | None
) -> NDArray[np.float64]:
    """Points (rows, cols, 3), m, NaN where nothing was measured.

    The file holds points, taken as they are, or z-depth, which needs the camera. shape is the
    image's. A point with any coordinate infinite or NaN is NaN in all.
    Raises: InputError where the file is no such range or of another shape.
    """
    info = _image_info(shape)
    with RANGES.open(path, image_shape=info.shape) as (file, chosen):
        raster = chosen.read(file, info)
    try:
        return _points(raster, info, camera)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def read_camera(path: Path | str, *, shape: tuple[int, ...] | None = None) -> Camera:
    """Camera intrinsics; shape, the image's, stands in where the file tells no width and height.

    Raises: InputError that names what is missing or wrong, and for a lens that distorts.
    """
    info = None if shape is None else _image_info(shape)
    with CAMERAS.open(path) as (file, chosen):
        return chosen.read(file, info)


def _image_info(shape: tuple[int, ...], name: str = "") -> ImageInfo:
    return ImageInfo((shape[0], shape[1]), name)


def _points(raster: RangeRaster, info: ImageInfo, camera: Camera | None) -> NDArray[np.float64]:
    values = raster.values
    if values.dtype.kind not in "fiu":
        raise InputError(f"expected numbers, found {values.dtype}")
    if values.shape not in (info.shape, (*info.shape, 3)):
        raise InputError(
            f"expected {info.shape} or {(*info.shape, 3)} as the image has, found {values.shape}"
        )
    metres = np.array(values, dtype=np.float64)
    if raster.unit == "step":
        metres *= _step_m(camera)
    if metres.ndim == 2:
        if camera is None:
            raise InputError(
                "z-depth: expected a camera (--camera) to turn it into points, found none"
            )
        metres[~(metres > 0)] = np.nan
        metres = camera.unproject(metres)
    metres[~np.isfinite(metres).all(axis=-1)] = np.nan
    return metres


def _step_m(camera: Camera | None) -> float:
    """Length of a step of integer range, m."""
    if camera is None:
        raise InputError(
            "z-depth in steps: expected a camera with depth_scale (--camera), found none"
        )
    if camera.depth_scale is None:
        raise InputError("z-depth in steps: expected depth_scale in the camera file")
    return camera.depth_scale / 1000
