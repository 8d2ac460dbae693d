"""Observations of files: image, range, camera and labels read and held to each other."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.lens import Lens
from rockshape.errors import InputError
from rockshape.inputs.arrays import observe
from rockshape.io import (
    ImageContent,
    read_labels,
    read_lens,
    read_pair,
    read_picture,
    read_points,
)
from rockshape.io.decoding.orientation import UPRIGHT
from rockshape.io.files import MAX_PIXELS
from rockshape.observation import Observation
from rockshape.point_grid.points import PointReading
from rockshape.point_grid.range_kinds import RangeKind
from rockshape.rock.instances import Instances
from rockshape.rock.pieces import Pieces
from rockshape.rock.rectification import rectification_of
from rockshape.stereo.pair_range import matching_note


def read(
    image: Path | str,
    *,
    range: Path | str | None = None,  # noqa: A002 - as the command line has it
    range_kind: RangeKind | None = None,
    range_unit: str | None = None,
    right: Path | str | None = None,
    camera: Path | str | None = None,
    camera_view: str | None = None,
    labels: Path | str | None = None,
    pieces: Pieces = "split",
    ignore: Path | str | None = None,
    max_pixels: int = MAX_PIXELS,
) -> Observation:
    """Observation of files, as `rockshape measure` reads them; `measure` takes it.

    The formats are those of `rockshape formats`. range_kind tells what the range file holds, if not
    what its format and shape do; range_unit is the unit of its numbers, `mm` or `0.25mm` say, or of
    the baseline. In place of range, right is the right picture of a stereo pair of which image is
    the left one and camera describes both; the point of each pixel is then matched. camera_view
    names one camera of a file of several. With labels, `measure` measures those rocks; pieces tells
    what becomes of a mask without ids. ignore is a mask in any format of labels, not 0 where no
    rock is to be found. An image of more than max_pixels is refused.
    Where the camera's lens distorts or its pixels are not square, image, range and rocks are
    resampled to those of a pinhole camera with square pixels.
    Raises: InputError, which names the file, for what cannot be read or does not fit the image.
    """
    if not isinstance(image, str | PathLike):
        raise InputError(
            f"image: expected a path, found {type(image).__name__}; rockshape.measure takes arrays"
        )
    picture = read_picture(image, max_pixels=max_pixels)
    shape, name = picture.pixels.shape, Path(image).name
    lens = seen = instances = ignored = None
    if right is not None and (range is not None or range_kind is not None):
        raise InputError(
            "right (--right): expected a stereo pair alone, "
            "found range (--range) or range_kind (--range-kind)"
        )
    with _telling_of_turning(picture):
        if camera is not None:
            lens = read_lens(camera, shape=shape, image_name=name, view=camera_view)
        if range is not None:
            seen = read_points(range, shape=shape, camera=lens, kind=range_kind, unit=range_unit)
        if right is not None:
            seen = read_pair(
                right, left=picture.pixels, camera=lens, unit=range_unit, max_pixels=max_pixels
            )
        if labels is not None:
            instances = read_labels(labels, shape=shape, image_name=name, pieces=pieces)
        if ignore is not None:
            ignored = read_labels(ignore, shape=shape, image_name=name, pieces="keep")
        observation = _observed(picture.pixels, lens, seen, instances, ignored)
    return replace(
        observation,
        pixel_size_m=picture.pixel_size_m if observation.image.shape == shape[:2] else None,
        map_frame=None if camera is not None else picture.map_frame,
        notes=(
            *_turning(picture),
            *([] if right is None or seen is None else [matching_note(seen)]),
            *observation.notes,
        ),
    )


def _observed(
    pixels: NDArray[np.generic],
    lens: Lens | None,
    seen: PointReading | None,
    instances: Instances | None,
    ignored: Instances | None,
) -> Observation:
    """Observation of what was read, resampled where the lens asks for it."""
    camera = None if lens is None else lens.pinhole
    points_m = None if seen is None else seen.points_m
    notes = () if instances is None else instances.notes
    rectification = rectification_of(lens)
    if rectification is not None:
        camera, pixels = rectification.camera, rectification.image(pixels)
        points_m = None if points_m is None else rectification.points(points_m)
        instances = None if instances is None else rectification.rocks(instances)
        ignored = None if ignored is None else rectification.rocks(ignored)
        size = f"{camera.width} x {camera.height}"
        notes = (*notes, f"image resampled to {size} square pixels without distortion")
    return replace(
        observe(pixels, camera=camera, labels=instances),
        points_m=points_m,
        ignored=None if ignored is None else _covered(ignored),
        left_out={} if seen is None else seen.left_out,
        notes=notes,
    )


def _covered(instances: Instances) -> NDArray[np.bool_]:
    mask = np.zeros(instances.shape, dtype=bool)
    for item in instances:
        mask[item.window] |= item.mask
    return mask


@contextmanager
def _telling_of_turning(picture: ImageContent) -> Iterator[None]:
    """Add to a refusal of what belongs to an image how the image has been turned."""
    try:
        yield
    except InputError as error:
        if picture.orientation == UPRIGHT:
            raise
        raise InputError("; ".join([str(error), *_turning(picture)])) from None


def _turning(picture: ImageContent) -> tuple[str, ...]:
    if picture.orientation == UPRIGHT:
        return ()
    return (
        f"the image was turned by its EXIF orientation {picture.orientation}, "
        f"and camera, range and labels must be of the turned image",
    )
