"""Measurement of arrays: from pixels and range to the measures of each rock in one call."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rockshape.camera.camera import Camera, CameraLike, as_camera
from rockshape.camera.lens import Lens, as_lens
from rockshape.errors import InputError
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
from rockshape.io.pixels import to_grey
from rockshape.measurement import Measurement
from rockshape.method import Method
from rockshape.numerics.array_argument import array_argument
from rockshape.observation import Observation
from rockshape.pipeline import measure as measure_observation
from rockshape.point_grid.points import PointReading, points_from
from rockshape.point_grid.range_kinds import UNNAMED, RangeKind
from rockshape.point_grid.units import RangeScale, parse_unit
from rockshape.rock.given_labels import instances_of
from rockshape.rock.instances import Instances
from rockshape.rock.pieces import Pieces
from rockshape.rock.rectification import rectification_of
from rockshape.segmentation.finders import Finder
from rockshape.stereo.pair_range import matching_note, points_of_arrays


def measure(
    image: ArrayLike | Observation | None = None,
    *,
    range_m: ArrayLike | None = None,
    range_unit: str | None = None,
    right: ArrayLike | None = None,
    camera: CameraLike | None = None,
    labels: ArrayLike | Instances | None = None,
    pieces: Pieces = "split",
    method: str | Method = "robust",
    find: str | Finder | None = None,
    descriptors: bool = False,
) -> Measurement:
    """Find the rocks in one image and measure each.

    - image: (rows, cols) or (rows, cols, 3), of 8 or 16 bits or floats from 0 to 1; or an
      Observation, as `rockshape.read` returns, which brings its own range and camera. It may be
      left out where range or labels are given.
    - range_m: points (rows, cols, 3) in the camera frame, or z-depth (rows, cols) with a camera;
      metres. NaN, infinity, a z-depth of 0, the point (0, 0, 0) and what is masked are no
      measurement.
    - range_unit: unit of range_m in place of metres, `mm` or `0.25mm` say; any distance is then
      believed. Without it a median distance below 1 cm or above 200 m is refused.
    - right: right picture of a rectified stereo pair, in place of range; the image is the left one,
      and its camera has `baseline_m` and may have `disparity_offset`, px.
    - camera: what took the image, any object or mapping with fx, fy, cx, cy in pixels. Needed for
      z-depth; else found from the points.
    - labels: rocks outlined already: (rows, cols) of whole numbers, 0 the ground, or Instances.
    - pieces: what becomes of labels with a single value in several pieces, a mask without ids:
      `split` makes each piece a rock, `keep` keeps one rock.
    - method: what is measured: `robust`, `paper`, another name in `rockshape.method.methods()`, or
      a Method.
    - find: how rocks are found: `range`, `image`, `both` or `published`, or a Finder; else as the
      method does.
    - descriptors: whether each rock gets the descriptors of its outline too.

    Nothing that is given is changed. Without range, measures that need it are NaN with a reason.
    Raises: InputError where arrays do not fit each other, and where rocks are to be found by range
        and there is none.
    """
    given = None if labels is None else instances_of(labels, pieces)
    if isinstance(image, Observation):
        if any(each is not None for each in (range_m, range_unit, right, camera)):
            raise InputError("measure: expected an Observation's own range and camera, not both")
        observation = image
    else:
        observation = observe(
            image,
            range_m=range_m,
            range_unit=range_unit,
            right=right,
            camera=camera,
            labels=given,
        )
    return measure_observation(
        observation, method=method, find=find, labels=given, descriptors=descriptors
    )


def observe(
    image: ArrayLike | None,
    *,
    range_m: ArrayLike | None = None,
    range_unit: str | None = None,
    right: ArrayLike | None = None,
    camera: CameraLike | None = None,
    labels: ArrayLike | Instances | None = None,
) -> Observation:
    """Observation of arrays as `measure` takes them; without an image a black one stands for it.

    Raises: InputError where the arrays do not fit each other, or there are none.
    """
    pixels = None if image is None else array_argument("image", image)
    instances = None if labels is None else instances_of(labels)
    points = None if range_m is None else array_argument("range_m", range_m)
    shapes = [array.shape[:2] for array in (pixels, points, instances) if array is not None]
    if not shapes:
        raise InputError("measure: expected image, range_m or labels, found none of them")
    if points is not None and points.shape[:2] != shapes[0]:
        raise InputError(f"range_m: expected {shapes[0]} as the image has, found {points.shape}")
    known = None if camera is None else as_camera(camera, shape=shapes[0])
    grey = np.zeros(shapes[0], dtype=np.float32) if pixels is None else to_grey(pixels)
    seen = None if points is None else _points(points, known, range_unit)
    notes = () if instances is None else instances.notes
    if right is not None:
        if points is not None:
            raise InputError("right: expected a stereo pair alone, found range_m beside it")
        seen = points_of_arrays(
            grey, to_grey(array_argument("right", right)), camera=camera, unit=range_unit
        )
        notes = (matching_note(seen), *notes)
    return Observation(
        image=grey,
        points_m=None if seen is None else seen.points_m,
        left_out={} if seen is None else seen.left_out,
        camera=known,
        colour=pixels if pixels is not None and pixels.ndim == 3 else None,
        instances=instances,
        notes=notes,
    )


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
    max_pixels: int = MAX_PIXELS,
) -> Observation:
    """Observation of files, as `rockshape measure` reads them; `measure` takes it.

    The formats are those of `rockshape formats`. range_kind tells what the range file holds, if not
    what its format and shape do; range_unit is the unit of its numbers, `mm` or `0.25mm` say, or of
    the baseline. In place of range, right is the right picture of a stereo pair of which image is
    the left one and camera describes both; the point of each pixel is then matched. camera_view
    names one camera of a file of several. With labels, `measure` measures those rocks; pieces tells
    what becomes of a mask without ids. An image of more than max_pixels is refused.
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
    lens = seen = instances = None
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
        observation = _observed(picture.pixels, lens, seen, instances)
    return replace(
        observation,
        pixel_size_m=picture.pixel_size_m if observation.image.shape == shape[:2] else None,
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
        size = f"{camera.width} x {camera.height}"
        notes = (*notes, f"image resampled to {size} square pixels without distortion")
    return replace(
        observe(pixels, camera=camera, labels=instances),
        points_m=points_m,
        left_out={} if seen is None else seen.left_out,
        notes=notes,
    )


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


def _points(range_m: NDArray[np.generic], camera: Camera | None, unit: str | None) -> PointReading:
    """Points (rows, cols, 3), a fresh array; one with any part unknown is unknown whole."""
    kind = UNNAMED.get(range_m.shape[2:]) if range_m.ndim > 1 else None
    if kind is None:
        raise InputError(
            f"range_m: expected (rows, cols) or (rows, cols, 3), found {range_m.shape}"
        )
    scale = RangeScale() if unit is None else parse_unit(unit)
    try:
        return points_from(range_m, kind=kind, camera=as_lens(camera), scale=scale)
    except InputError as error:
        raise InputError(f"range_m: {error}") from None
