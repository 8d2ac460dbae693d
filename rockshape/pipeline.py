"""From an observation to the measures of each rock in it."""

from dataclasses import dataclass

import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray

from rockshape.camera import Camera
from rockshape.descriptors import describe_smooth
from rockshape.ellipse import Ellipse
from rockshape.ellipsoid import Ellipsoid
from rockshape.errors import InputError
from rockshape.ground import Plane
from rockshape.measurement import Measurement, Rock
from rockshape.measures import METHODS
from rockshape.observation import Observation
from rockshape.range_noise import RangeNoise, estimate_range_noise
from rockshape.rock_view import RockView
from rockshape.segmentation import Found, Variant, ground_under, segment
from rockshape.threads import one_blas_thread
from rockshape.visibility import visible_fraction


@one_blas_thread()
def measure(
    observation: Observation,
    *,
    method: str = "paper",
    labels: NDArray[np.int32] | None = None,
    descriptors: bool = False,
) -> Measurement:
    """Find the rocks in an observation and measure each.

    With labels, (rows, cols) of whole numbers with 0 the ground, nothing is segmented; of a number
    in several pieces the largest is measured. The published way needs range to find rocks by:
    without labels and range `paper` returns none. With descriptors, each rock gets the everyday
    numbers of its outline too.
    Raises InputError for an unknown method or labels of another shape.
    """
    if method not in METHODS:
        raise InputError(f"method: expected one of {', '.join(METHODS)}, found {method!r}")
    shape = observation.image.shape
    if labels is not None and labels.shape != shape:
        raise InputError(f"labels: expected {shape} as the image has, found {labels.shape}")
    points_m = observation.points_m
    variant: Variant = "robust" if method == "robust" else "paper"
    found: tuple[Found, ...] = ()
    if labels is None:
        segmentation = segment(observation, variant=variant)
        labels, ground, frame = segmentation.labels, segmentation.ground, segmentation.frame
        found = segmentation.found
    else:
        ground = ground_under(observation, variant=variant)
        frame = (slice(0, shape[0]), slice(0, shape[1]))
    noise = None
    if method == "robust" and ground is not None and points_m is not None:
        noise = estimate_range_noise(points_m, ground, labels != 0)
    scene = _Scene(
        labels=labels,
        points_m=points_m,
        camera=observation.camera,
        ground=ground,
        noise=noise,
        frame=frame,
        method=method,
        described=descriptors,
    )
    rocks = tuple(_measure_rock(scene, patch) for patch in _patches(labels))
    return Measurement(
        method=method,
        labels=labels,
        ground=ground,
        rocks=rocks,
        found=found,
        described=descriptors,
    )


@dataclass(frozen=True, eq=False)
class _Scene:
    """What the rocks of one image share."""

    labels: NDArray[np.int32]  # (rows, cols)
    points_m: NDArray[np.float64] | None  # (rows, cols, 3)
    camera: Camera | None
    ground: Plane | None
    noise: RangeNoise | None
    frame: tuple[slice, slice]  # rows and columns in which rocks could be found
    method: str
    described: bool  # whether descriptors are wanted


@dataclass(frozen=True, eq=False)
class _Patch:
    """A rock's pixels: the largest part that hangs together."""

    number: int
    window: tuple[slice, slice]  # the box they lie in
    mask: NDArray[np.bool_]  # within the box


def _patches(labels: NDArray[np.int32]) -> list[_Patch]:
    """The pixels of each number in the label image, in the order of the numbers."""
    rocks = labels != 0
    numbers = np.unique(labels[rocks])
    dense = np.zeros(labels.shape, dtype=np.int32)
    dense[rocks] = np.searchsorted(numbers, labels[rocks]) + 1
    return [
        _largest_part(int(number), window, labels[window] == number)
        for number, window in zip(numbers, ndi.find_objects(dense), strict=True)
    ]


def _largest_part(number: int, window: tuple[slice, slice], mask: NDArray[np.bool_]) -> _Patch:
    parts, count = ndi.label(mask, structure=np.ones((3, 3)))
    if count == 1:
        return _Patch(number, window, mask)
    largest = int(np.argmax(np.bincount(parts.ravel())[1:])) + 1
    rows, cols = ndi.find_objects(parts)[largest - 1]
    inner = tuple(
        slice(whole.start + part.start, whole.start + part.stop)
        for whole, part in zip(window, (rows, cols), strict=True)
    )
    return _Patch(number, (inner[0], inner[1]), parts[rows, cols] == largest)


def _measure_rock(scene: _Scene, patch: _Patch) -> Rock:
    rows, cols = patch.window
    view = _view_rock(scene, patch)
    ellipse, ellipsoid = _fits(view, scene.method)
    readings = {measure.column: measure.read(view) for measure in METHODS[scene.method]}
    pixel_rows, pixel_cols = np.nonzero(patch.mask)
    return Rock(
        number=patch.number,
        row=rows.start + float(pixel_rows.mean()),
        col=cols.start + float(pixel_cols.mean()),
        area_px=len(pixel_rows),
        width_px=cols.stop - cols.start,
        height_px=rows.stop - rows.start,
        truncated=view.truncated,
        visible_fraction=visible_fraction(patch.number, ellipse, scene.labels, scene.points_m),
        outline_px=view.outline_px,
        ellipse=ellipse,
        ellipsoid=ellipsoid,
        readings=readings,
        descriptors=describe_smooth(view.smooth_outline_px) if scene.described else None,
    )


def _fits(view: RockView, method: str) -> tuple[Ellipse | None, Ellipsoid | None]:
    """The ellipse and ellipsoid that a method's measures are of."""
    if method == "robust":
        return view.form_ellipse, view.held_ellipsoid
    return view.ellipse, None if view.ellipsoid is None else view.ellipsoid.ellipsoid


def _view_rock(scene: _Scene, patch: _Patch) -> RockView:
    rows, cols = patch.window
    return RockView(
        mask=patch.mask,
        corner=(rows.start, cols.start),
        grid_m=None if scene.points_m is None else scene.points_m[patch.window],
        camera=scene.camera,
        ground=scene.ground,
        frame=scene.frame,
        noise=scene.noise,
    )
