"""Measuring pipeline: from an observation to the readings of each rock in it."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.measurement import Measurement, Rock
from rockshape.measures import Reading
from rockshape.measures.reading import NAN
from rockshape.method import Fits, Method, find_method
from rockshape.observation import Observation, locate_camera
from rockshape.outline.descriptors import UNRESOLVED, Descriptors, describe_edge, describe_outline
from rockshape.point_grid.flying import flying_pixels
from rockshape.rock.blas_threads import one_blas_thread
from rockshape.rock.contacts import not_ground
from rockshape.rock.flags import KnownOfRock
from rockshape.rock.instances import Instance, Instances, Window
from rockshape.rock.point_fit import PointCounts
from rockshape.rock.sizes import Sizes, pixel_on_rock_m, sizes_of
from rockshape.rock.view import RockView
from rockshape.rock.visibility import visibility
from rockshape.segmentation.finders import Finder, find_finder
from rockshape.segmentation.ignored import without_ignored
from rockshape.uncertainty import Observables, Uncertainty, estimates, observe

if TYPE_CHECKING:
    from rockshape.ground import Ground
    from rockshape.segmentation import FoundRock


def measure(
    observation: Observation,
    *,
    method: str | Method = "robust",
    find: str | Finder | None = None,
    labels: NDArray[np.int32] | Instances | None = None,
    descriptors: bool = False,
    sizes: bool = False,
) -> Measurement:
    """Find the rocks in an observation and measure each.

    - method: what is measured, and how rocks are found unless `find` says so.
    - find: a Finder, or a name in `rockshape.segmentation.finders()`.
    - labels: rocks outlined already, in place of the observation's own: a label image (rows, cols)
      with 0 the ground, or Instances. Nothing is then found. Of a rock in several pieces the
      largest is measured.
    - descriptors: whether each rock gets the descriptors of its outline too.
    - sizes: whether each gets its axes, Feret diameters and area, px and, with a scale, mm.

    The camera is located first where range is given without one.
    Raises: InputError for an unknown method or finder, labels of another shape, a finder given
        beside labels, and range that the finder needs and has not.
    """
    method = find_method(method)
    given = _given(observation, labels)
    if given is not None and find is not None:
        raise InputError("find: expected no finder where rocks are given by labels")
    if given is not None and observation.ignored is not None:
        raise InputError("ignore: expected rocks that are to be found, found rocks given by labels")
    scene = _scene(locate_camera(observation), method, find, given)
    with one_blas_thread():
        rocks = _measure_rocks(scene, method, _Asked(descriptors=descriptors, sizes=sizes))
    return Measurement(
        method=method.name,
        measures=method.measures,
        observation=scene.observation,
        instances=scene.instances,
        ground=scene.ground,
        rocks=rocks,
        found=scene.found,
        described=descriptors,
        sized=sizes,
        flagged=method.flags is not None,
    )


@dataclass(frozen=True)
class _Asked:
    """What each rock gets beside its measures."""

    descriptors: bool
    sizes: bool


@dataclass(frozen=True, eq=False)
class _Scene:
    """What the rocks of one image share."""

    observation: Observation
    instances: Instances
    frame: Window  # rows and columns in which rocks could be found
    flying: NDArray[np.bool_] | None  # (rows, cols), points that no rock is measured on
    ground: "Ground | None" = None
    found: "tuple[FoundRock, ...]" = ()

    @cached_property
    def found_by_number(self) -> "dict[int, FoundRock]":
        """How each rock was found; none where they were given."""
        return {one.number: one for one in self.found}


def _given(
    observation: Observation, labels: NDArray[np.int32] | Instances | None
) -> Instances | None:
    if labels is None:
        return observation.instances
    if labels.shape != observation.image.shape:
        raise InputError(
            f"labels: expected {observation.image.shape} as the image has, found {labels.shape}"
        )
    return labels if isinstance(labels, Instances) else Instances.from_labels(labels)


def _scene(
    observation: Observation, method: Method, find: str | Finder | None, given: Instances | None
) -> _Scene:
    """Where the rocks are and what they stand on; of rocks that are given, the latter alone."""
    found: tuple[FoundRock, ...] = ()
    with one_blas_thread():
        if given is not None:
            rows, cols = given.shape
            frame = slice(0, rows), slice(0, cols)
            instances, ground = given, method.ground(observation)
        else:
            segment = method.segment if find is None else find_finder(find).segment
            segmented = segment(observation)
            if observation.ignored is not None:
                segmented = without_ignored(segmented, observation.ignored)
            instances, ground = segmented.instances, segmented.ground
            frame, found = segmented.frame, segmented.found
            if find is not None and (ground is None or ground.noise is None):
                # a finder of another method may have no noise model, which measures can need
                ground = method.ground(observation)
    return _Scene(observation, instances, frame, _flying(observation), ground, found)


def _flying(observation: Observation) -> NDArray[np.bool_] | None:
    """Flying pixels (rows, cols); None without range in a camera's frame."""
    if observation.points_m is None or observation.camera is None:
        return None
    return flying_pixels(observation.points_m, pixel_rad=1.0 / observation.camera.fx)


def _measure_rocks(scene: _Scene, method: Method, asked: _Asked) -> tuple[Rock, ...]:
    """Measure every rock; measures that take a batch see all of them first."""
    parts = scene.instances.largest_parts()
    whole = {item.id: item for item in scene.instances}
    batched = [one for one in method.measures if one.evaluate_batch is not None]
    views = [_view_rock(scene, part) for part in parts] if batched else []
    answers = {one.column: one.read_all(views) for one in batched}
    rocks = []
    for index, part in enumerate(parts):
        view = views[index] if views else _view_rock(scene, part)
        readings = {
            one.column: answers[one.column][index] if one.column in answers else one.read(view)
            for one in method.measures
        }
        rocks.append(
            _rock(
                scene,
                whole[part.id],
                part,
                view=view,
                method=method,
                readings=readings,
                asked=asked,
            )
        )
    return tuple(rocks)


def _rock(
    scene: _Scene,
    whole: Instance,
    part: Instance,
    *,
    view: RockView,
    method: Method,
    readings: dict[str, Reading],
    asked: _Asked,
) -> Rock:
    fits = method.fits(view)
    rows, cols = part.window
    outline_px = (view.edge_px if fits.outline_px is None else fits.outline_px).view()
    outline_px.setflags(write=False)
    pixel_rows, pixel_cols = np.nonzero(part.mask)
    descriptors = _describe(view) if asked.descriptors or asked.sizes else UNRESOLVED
    visible = visibility(
        whole,
        fits.ellipse,
        scene.instances,
        scene.observation.points_m,
        scene.observation.ignored,
    )
    rock = Rock(
        number=part.id,
        row=rows.start + float(pixel_rows.mean()),
        col=cols.start + float(pixel_cols.mean()),
        area_px=len(pixel_rows),
        width_px=cols.stop - cols.start,
        height_px=rows.stop - rows.start,
        truncated=view.truncated,
        visible_fraction=visible.fraction,
        outline_px=outline_px,
        outline_share=view.outline_share,
        points=_counts(
            view,
            flying=_flying_on(scene, part),
            constrained=any(one.constrained for one in method.measures),
        ),
        ellipse=fits.ellipse,
        ellipsoid=fits.ellipsoid,
        half_axes_m=_half_axes(fits),
        readings=readings,
        descriptors=descriptors if asked.descriptors else None,
        sizes=_sizes(view, descriptors, scene.observation) if asked.sizes else None,
        observables=_observables(view, method, visible.least, scene.found_by_number.get(part.id)),
    )
    return _estimated(_flagged(rock, view, method, scene), method)


def _flagged(rock: Rock, view: RockView, method: Method, scene: _Scene) -> Rock:
    """Rock with the flags of its finder, and after them those that the method tells."""
    found = scene.found_by_number.get(rock.number)
    flags = () if found is None else found.flags
    if method.flags is not None:
        sd_px, is_drawn = (NAN, False) if found is None else (found.outline_sd_px, found.is_drawn)
        known = KnownOfRock(rock.visible_fraction, sd_px, is_drawn, rock.values)
        flags = (*flags, *method.flags(view, known))
    return replace(rock, flags=tuple(dict.fromkeys(flags)))


def _observables(
    view: RockView, method: Method, least_visible: float, found: "FoundRock | None"
) -> Observables | None:
    """What the errors of a rock's values depend on; None where they are not estimated.

    They are not where the frame cuts the rock, where the method has no error model, nor where the
    image branch has drawn the outline without range: on photographs it errs more than on made
    rocks.
    """
    if method.errors is None or view.truncated:
        return None
    by_image_branch = found is not None and found.branch == "image" and not found.is_drawn
    if by_image_branch and not len(view.points_m):
        return None
    return observe(view, visible_fraction=least_visible, found=found is not None)


def _estimated(rock: Rock, method: Method) -> Rock:
    """Rock with the uncertainty of its values and axes, where it is estimated."""
    if method.errors is None or rock.observables is None:
        return rock
    models = method.errors().of(rock.observables)
    found = estimates(rock.quantities, rock.observables, models, method.value_ranges)
    readings = {name: _with(reading, found.get(name)) for name, reading in rock.readings.items()}
    return replace(rock, readings=readings, estimates=found)


def _with(reading: Reading, estimate: Uncertainty | None) -> Reading:
    """Reading with its uncertainty."""
    if estimate is None:
        return reading
    interval = (estimate.low, estimate.high)
    return Reading(reading.value, reading.unit, reading.reason, estimate.sd, interval)


def _sizes(view: RockView, descriptors: Descriptors, observation: Observation) -> Sizes:
    pixel_m = pixel_on_rock_m(
        view, level_ground=observation.level_ground, told_m=observation.pixel_size_m
    )
    return sizes_of(view, descriptors, pixel_m=pixel_m)


def _half_axes(fits: Fits) -> NDArray[np.float64] | None:
    """Half-axes (3,) of a rock, read-only: the method's own, or its ellipsoid's."""
    half_axes_m = fits.half_axes_m
    if half_axes_m is None and fits.ellipsoid is not None:
        half_axes_m = fits.ellipsoid.half_axes_m
    if half_axes_m is None:
        return None
    half_axes_m = half_axes_m.view()
    half_axes_m.setflags(write=False)
    return half_axes_m


def _flying_on(scene: _Scene, part: Instance) -> NDArray[np.bool_]:
    """A rock's pixels (rows, cols) whose point flies."""
    if scene.flying is None:
        return np.zeros_like(part.mask)
    return scene.flying[part.window] & part.mask


def _counts(view: RockView, *, flying: NDArray[np.bool_], constrained: bool) -> PointCounts:
    """Range points used, and those left out before any fit and, of constrained fits, by it."""
    if constrained and len(view.points_m):
        counts = view.point_fit.counts(view.mask)
    else:
        counts = PointCounts(len(view.points_m))
    return replace(counts, flying_points=counts.flying_points + int(flying.sum()))


def _describe(view: RockView) -> Descriptors:
    """Descriptors of the outline; only a pixel edge has a staircase that lengthens it."""
    if not view.resolved:
        return UNRESOLVED
    if view.has_subpixel_edge:
        return describe_outline(view.smooth_outline_px)
    return describe_edge(view.edge_px)


def _view_rock(scene: _Scene, part: Instance) -> RockView:
    rows, cols = part.window
    points_m = scene.observation.points_m
    grid_m = None if points_m is None else points_m[part.window]
    flying = _flying_on(scene, part)
    if grid_m is not None and flying.any():
        grid_m = np.where(flying[..., None], np.nan, grid_m)
    return RockView(
        mask=part.mask,
        corner=(rows.start, cols.start),
        grid_m=grid_m,
        camera=scene.observation.camera,
        ground=scene.ground,
        frame=scene.frame,
        subpixel_px=part.outline_px,
        hidden=not_ground(part, scene.instances, scene.frame, scene.observation.ignored),
        image=scene.observation.image[part.window],
    )
