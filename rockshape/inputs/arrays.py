"""Observations of arrays: image, range, camera and labels held to each other."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rockshape.camera.camera import Camera, CameraLike, as_camera
from rockshape.camera.lens import as_lens
from rockshape.errors import InputError
from rockshape.io.pixels import to_grey
from rockshape.numerics.array_argument import array_argument
from rockshape.observation import Observation
from rockshape.point_grid.points import PointReading, points_from
from rockshape.point_grid.range_kinds import UNNAMED
from rockshape.point_grid.units import RangeScale, parse_unit
from rockshape.rock.given_labels import instances_of
from rockshape.rock.instances import Instances
from rockshape.stereo.pair_range import matching_note, points_of_arrays


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
