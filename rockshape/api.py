"""For people with arrays: one call from pixels and range to the measures of each rock."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rockshape.camera.camera import Camera
from rockshape.errors import InputError
from rockshape.io.pixels import to_grey
from rockshape.measurement import Measurement
from rockshape.method import Method
from rockshape.observation import Observation
from rockshape.pipeline import measure as measure_observation


def measure(
    image: ArrayLike | None = None,
    *,
    range_m: ArrayLike | None = None,
    camera: Camera | None = None,
    labels: ArrayLike | None = None,
    method: str | Method = "paper",
    descriptors: bool = False,
) -> Measurement:
    """Measure the rocks in one image.

    - image: (rows, cols) or (rows, cols, 3), of 8 or 16 bits or floats from 0 to 1. The measures
      take nothing from it, so it may be left out; `robust` finds rocks in it, and outlines at its
      edges, and pictures of the measurement need it.
    - range_m: points (rows, cols, 3) in the camera frame, or z-depth (rows, cols) with a camera;
      metres, NaN, infinity or, in z-depth, 0 where nothing was measured.
    - camera: what took the image. Needed for z-depth; else found from the points.
    - labels: (rows, cols) of whole numbers, 0 the ground: rocks outlined already. Without labels
      rocks are found by range, by `robust` in the image too.
    - method: how rocks are found and measured, a name in `rockshape.method.methods()` or a Method.
    - descriptors: whether each rock gets the everyday numbers of its outline too.

    The result is a frozen record; `.rocks` holds a record for each rock, `.to_frame()` the table.
    Nothing given is changed. Raises InputError where the arrays do not fit each other, or there is
    nothing to find rocks by: `paper` needs range or labels, `robust` does with an image.
    """
    numbers = None if labels is None else _whole(np.asarray(labels))
    points_m = None if range_m is None else _points(np.asarray(range_m), camera)
    if numbers is None and points_m is None and image is None:
        raise InputError("measure: expected image, range_m or labels, found none of them")
    if image is not None:
        grey = to_grey(np.asarray(image))
    else:
        grid = next(grid for grid in (points_m, numbers) if grid is not None)
        grey = np.zeros(grid.shape[:2], dtype=np.float32)
    observation = Observation(image=grey, points_m=points_m, camera=camera)
    return measure_observation(observation, method=method, labels=numbers, descriptors=descriptors)


def _points(range_m: NDArray[np.generic], camera: Camera | None) -> NDArray[np.float64]:
    """Points (rows, cols, 3), a fresh array; one with any part unknown is unknown whole."""
    if range_m.dtype.kind not in "fiu":
        raise InputError(f"range_m: expected numbers, found {range_m.dtype}")
    points = np.array(range_m, dtype=np.float64)
    if points.ndim == 2:
        if camera is None:
            raise InputError("range_m: expected a camera to turn z-depth into points, found none")
        points[~(points > 0)] = np.nan
        points = camera.unproject(points)
    if points.ndim != 3 or points.shape[2] != 3:
        raise InputError(f"range_m: expected (rows, cols) or (rows, cols, 3), found {points.shape}")
    points[~np.isfinite(points).all(axis=-1)] = np.nan
    return points


def _whole(labels: NDArray[np.generic]) -> NDArray[np.int32]:
    if labels.ndim != 2 or labels.dtype.kind not in "biu":
        raise InputError(
            f"labels: expected (rows, cols) of whole numbers, "
            f"found {labels.shape} of {labels.dtype}"
        )
    numbers = labels.astype(np.int64)
    if labels.size and not 0 <= numbers.min() <= numbers.max() <= np.iinfo(np.int32).max:
        raise InputError(
            f"labels: expected 0 to 2147483647, found {numbers.min()} to {numbers.max()}"
        )
    return numbers.astype(np.int32)
