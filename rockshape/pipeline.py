"""From an observation to the measures of each rock in it."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.errors import InputError
from rockshape.ground.pixel_noise import RangeNoise, estimate_range_noise
from rockshape.measurement import Measurement, Rock
from rockshape.method import Method, find_method
from rockshape.observation import Observation
from rockshape.outline.descriptors import describe_smooth
from rockshape.rock.blas_threads import one_blas_thread
from rockshape.rock.patches import Patch, find_patches
from rockshape.rock.view import RockView
from rockshape.rock.visibility import visible_fraction

if TYPE_CHECKING:
    from rockshape.ground import Ground
    from rockshape.segmentation import FoundRock


def measure(
    observation: Observation,
    *,
    method: str | Method = "paper",
    labels: NDArray[np.int32] | None = None,
    descriptors: bool = False,
) -> Measurement:
    """Find the rocks in an observation and measure each.

    With labels, (rows, cols) of whole numbers with 0 the ground, nothing is segmented; of a number
    in several pieces the largest is measured. With descriptors, each rock gets the everyday
    numbers of its outline too.
    Raises: InputError for an unknown method, labels of another shape, and without labels where the
    method finds rocks by range and there is none.
    """
    method = find_method(method)
    shape = observation.image.shape
    if labels is not None and labels.shape != shape:
        raise InputError(f"labels: expected {shape} as the image has, found {labels.shape}")
    if labels is None or observation.points_m is not None:
        scene, found = _find(observation, method, labels)
    else:
        scene, found = _Scene(labels=labels, frame=_whole(shape), camera=observation.camera), ()
    with one_blas_thread():
        rocks = tuple(
            _measure_rock(scene, patch, method=method, described=descriptors)
            for patch in find_patches(scene.labels)
        )
    return Measurement(
        method=method.name,
        measures=method.measures,
        labels=scene.labels,
        ground=scene.ground,
        rocks=rocks,
        found=found,
        described=descriptors,
    )


@dataclass(frozen=True, eq=False)
class _Scene:
    """What the rocks of one image share."""

    labels: NDArray[np.int32]  # (rows, cols)
    frame: tuple[slice, slice]  # rows and columns in which rocks could be found
    camera: Camera | None
    points_m: NDArray[np.float64] | None = None  # (rows, cols, 3)
    ground: "Ground | None" = None
    noise: RangeNoise | None = None


def _whole(shape: tuple[int, ...]) -> tuple[slice, slice]:
    return slice(0, shape[0]), slice(0, shape[1])


def _find(
    observation: Observation, method: Method, labels: NDArray[np.int32] | None
) -> "tuple[_Scene, tuple[FoundRock, ...]]":
    """Where the rocks are and what they stand on; with labels, the latter alone."""
    points_m, noise = observation.points_m, None
    found: tuple[FoundRock, ...] = ()
    with one_blas_thread():
        if labels is None:
            segmentation = method.segment(observation)
            labels, ground, frame = segmentation.labels, segmentation.ground, segmentation.frame
            found = segmentation.found
        else:
            ground, frame = method.ground(observation), _whole(labels.shape)
        if ground is not None and points_m is not None:
            noise = estimate_range_noise(points_m, ground.plane, labels != 0)
    scene = _Scene(
        labels=labels,
        frame=frame,
        camera=observation.camera,
        points_m=points_m,
        ground=ground,
        noise=noise,
    )
    return scene, found


def _measure_rock(scene: _Scene, patch: Patch, *, method: Method, described: bool) -> Rock:
    rows, cols = patch.window
    view = _view_rock(scene, patch)
    fits = method.fits(view)
    readings = {measure.column: measure.read(view) for measure in method.measures}
    pixel_rows, pixel_cols = np.nonzero(patch.mask)
    return Rock(
        number=patch.number,
        row=rows.start + float(pixel_rows.mean()),
        col=cols.start + float(pixel_cols.mean()),
        area_px=len(pixel_rows),
        width_px=cols.stop - cols.start,
        height_px=rows.stop - rows.start,
        truncated=view.truncated,
        visible_fraction=visible_fraction(patch.number, fits.ellipse, scene.labels, scene.points_m),
        outline_px=view.outline_px,
        ellipse=fits.ellipse,
        ellipsoid=fits.ellipsoid,
        readings=readings,
        descriptors=describe_smooth(view.smooth_outline_px) if described else None,
    )


def _view_rock(scene: _Scene, patch: Patch) -> RockView:
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
