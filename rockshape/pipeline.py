"""From an observation to the measures of each rock in it."""

from dataclasses import dataclass

import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray

from rockshape.ellipse import Ellipse, fit_ellipse
from rockshape.ellipsoid import Ellipsoid, fit_ellipsoid
from rockshape.errors import InputError
from rockshape.ground import Plane, fit_plane
from rockshape.measures import METHODS, Measure, RockView
from rockshape.observation import Observation
from rockshape.outline import trace_outline
from rockshape.segmentation import segment
from rockshape.surface import fit_surface, view_patch
from rockshape.visibility import measured_frame, touches_border, visible_fraction


@dataclass(frozen=True, eq=False)
class Rock:
    """One rock's row of the table, with the outline and fits it was measured on."""

    number: int  # the value of its pixels in the label image
    row: float  # centroid of its pixels
    col: float
    area_px: int
    width_px: int
    height_px: int
    truncated: bool  # touches the border of the frame, or of its measured part if found by range
    visible_fraction: float  # of the fitted ellipse, in the frame and not behind a nearer rock
    outline_px: NDArray[np.float64]  # (n, 2) as (x, y)
    ellipse: Ellipse | None
    ellipsoid: Ellipsoid | None
    values: dict[str, float]  # by the measures' columns
    reason: str  # why a value is NaN; empty where none is


@dataclass(frozen=True, eq=False)
class Measurement:
    """What was found in one image."""

    method: str
    labels: NDArray[np.int32]  # (rows, cols), 0 the ground
    ground: Plane | None
    rocks: tuple[Rock, ...]  # in the order of their numbers


def measure(
    observation: Observation,
    *,
    method: str = "paper",
    labels: NDArray[np.int32] | None = None,
) -> Measurement:
    """Find the rocks in an observation and measure each.

    With labels, (rows, cols) of whole numbers with 0 the ground, nothing is segmented; of a number
    in several pieces the largest is measured. Without labels and without range there is nothing to
    find rocks by: no rock is returned.
    Raises InputError for an unknown method or labels of another shape.
    """
    if method not in METHODS:
        raise InputError(f"method: expected one of {', '.join(METHODS)}, found {method!r}")
    shape = observation.image.shape
    if labels is not None and labels.shape != shape:
        raise InputError(f"labels: expected {shape} as the image has, found {labels.shape}")
    points_m = observation.points_m
    ground = None if points_m is None else fit_plane(points_m)
    frame = (slice(0, shape[0]), slice(0, shape[1]))
    if labels is None:
        labels = np.zeros(shape, dtype=np.int32)
        if ground is not None and points_m is not None:
            height_m = ground.height_m(points_m)
            labels = segment(height_m, sigma_m=ground.sigma_m)
            frame = measured_frame(np.isfinite(height_m))
    scene = _Scene(labels=labels, points_m=points_m, frame=frame, measures=METHODS[method])
    rocks = tuple(_measure_rock(scene, patch) for patch in _patches(labels))
    return Measurement(method=method, labels=labels, ground=ground, rocks=rocks)


@dataclass(frozen=True, eq=False)
class _Scene:
    """What the rocks of one image share."""

    labels: NDArray[np.int32]  # (rows, cols)
    points_m: NDArray[np.float64] | None  # (rows, cols, 3)
    frame: tuple[slice, slice]  # rows and columns in which rocks could be found
    measures: tuple[Measure, ...]


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
    values = {measure.column: measure.evaluate(view) for measure in scene.measures}
    pixel_rows, pixel_cols = np.nonzero(patch.mask)
    return Rock(
        number=patch.number,
        row=rows.start + float(pixel_rows.mean()),
        col=cols.start + float(pixel_cols.mean()),
        area_px=len(pixel_rows),
        width_px=cols.stop - cols.start,
        height_px=rows.stop - rows.start,
        truncated=touches_border(patch.window, scene.frame),
        visible_fraction=visible_fraction(patch.number, view.ellipse, scene.labels, scene.points_m),
        outline_px=view.outline_px,
        ellipse=view.ellipse,
        ellipsoid=None if view.ellipsoid is None else view.ellipsoid.ellipsoid,
        values=values,
        reason=_reason(scene, view, values),
    )


def _view_rock(scene: _Scene, patch: _Patch) -> RockView:
    """Outline, points and those fits of one rock that its pixels and points determine."""
    rows, cols = patch.window
    outline = trace_outline(patch.mask) + np.array([cols.start, rows.start])
    points = np.empty((0, 3))
    if scene.points_m is not None:
        points = scene.points_m[patch.window][patch.mask]
        points = points[np.isfinite(points).all(axis=1)]
    graph = view_patch(points)
    ellipsoid = fit_ellipsoid(points)
    if ellipsoid is not None and (ellipsoid.bounded or not ellipsoid.converged):
        ellipsoid = None
    return RockView(
        outline_px=outline,
        points_m=points,
        ellipse=fit_ellipse(outline),
        ellipsoid=ellipsoid,
        surface=None if graph is None else fit_surface(graph),
    )


def _reason(scene: _Scene, view: RockView, values: dict[str, float]) -> str:
    """Why values are NaN: `no range`, `too small` or `degenerate`, each said once."""
    reasons = []
    for measure in scene.measures:
        if np.isfinite(values[measure.column]):
            continue
        if measure.needs_range and len(view.points_m) == 0:
            reasons.append("no range")
        elif len(view.points_m if measure.needs_range else view.outline_px) < measure.fewest:
            reasons.append("too small")
        else:
            reasons.append("degenerate")
    return "; ".join(dict.fromkeys(reasons))
