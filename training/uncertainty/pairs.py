"""Made rocks seen by a coarse camera and by a fine one, and what each says of them."""

from collections.abc import Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import rockshape
from rockshape.measurement import AXES, Rock
from rockshape.method import ROBUST
from rockshape.uncertainty import ErrorModels, Observables
from synth.camera.trajectories import camera_of
from synth.dataset.files import plain
from synth.dataset.shape_truth import scene_gt_shape
from synth.dataset.write import capture_frame
from synth.errors import SpecError
from synth.handle.truth import truth_table
from synth.light import spec_stage
from synth.render import choose_backend, open_renderer
from synth.render.view import RenderedView
from synth.scene.laying import PlacedRock
from synth.scene.scene import SceneModel, build_scene
from synth.sensor import Capture
from synth.spec import SceneSpec
from training.uncertainty.scenes import NOISE, VIEWS, Kind, draw_spec, noisy, with_camera
from validation.records.match import match_labels

UNESTIMATED = replace(ROBUST, errors=ErrorModels)  # without the models that are to be fitted
# columns of the truth that are the same quantity as a value
OF_ROCK = {
    "sphericity_3d": "maximum_projection_sphericity",
    "axis_a_m": "half_axis_a_m",
    "axis_b_m": "half_axis_b_m",
    "axis_c_m": "half_axis_c_m",
}
OF_OUTLINE = {"axis_ratio": "outline_axis_ratio", "roundness": "outline_roundness"}
MOST_BURIED = 0.02  # of a rock whose true outline is the one in sight
LEAST_SEEN = 0.4  # of a rock, for its value to be compared
MIN_IOU = 0.5  # of a found rock's pixels with a true one's, for it to be that


class Way(NamedTuple):
    """Where the outlines and the range of a view's rocks come from."""

    range_kind: str  # none or stereo, the noise of the range; `NO_RANGE` without any
    finder: str | None  # None: true labels


NO_RANGE = "no range"
GIVEN = (Way("none", None), Way(NOISE, None))
FOUND = (Way("none", "both"), Way(NOISE, "both"), Way(NO_RANGE, "network"))


@dataclass(frozen=True)
class Pair:
    """One rock in one coarse view, in one way: values, true values and observables."""

    scene: int
    family: str
    camera: str
    range_kind: str
    distance_m: float
    buried: float
    hidden: float  # true share behind nearer rocks
    values: dict[str, float]
    truths: dict[str, float]
    observables: Observables


def made_pairs(
    seed: int,
    scenes: Iterable[int],
    families: Sequence[str],
    *,
    scans: Sequence[str] = (),
    ways: Sequence[Way] = GIVEN,
) -> Iterator[Pair]:
    """Yield the rocks of scenes of a seed, each from two sides, in each way.

    Families take turns; of every three scenes of a family one has worn rocks, and one rocks that
    hide one another in part. What a fine camera measures of a rock alone, from the same place and
    on exact range, stands for the truth where a quantity has none of its own, and for that of an
    outline which the ground cuts.
    """
    for scene in scenes:
        turn, which = divmod(scene, len(families))
        rng = np.random.default_rng([seed, 90, scene])
        kind = Kind(worn=turn % 3 == 1 and not scans, crowded=turn % 3 == 2)
        spec, camera = draw_spec(rng, seed * 1000 + scene, families[which], scans, kind)
        try:
            yield from _pairs(scene, spec, camera, ways)
        except SpecError:  # no room for the rocks
            continue


def _pairs(scene: int, fine: SceneSpec, camera: str, ways: Sequence[Way]) -> Iterator[Pair]:
    coarse = noisy(with_camera(fine, camera))
    near = build_scene(fine, 0)
    far = replace(near, camera=camera_of(coarse.camera))
    alone = [_alone(fine, near, rock) for rock in near.rocks]
    taken = list(_views(coarse, far))
    truth = plain(scene_gt_shape(far, 1, [view.sight() for view, _ in taken]))
    for number, (view, capture) in enumerate(taken):
        seen = truth["views"][str(number)]
        told = truth_table(truth["rocks"], seen).set_index("id").to_dict("index")
        for way, true, rock in _readings(coarse, view, capture, ways):
            own = told[true]
            if own["visible_fraction"] < LEAST_SEEN or rock.observables is None:
                continue
            yield Pair(
                scene=scene,
                family=str(own["family"]),
                camera=camera,
                range_kind=way.range_kind,
                distance_m=float(own["depth_m"]),
                buried=float(own["buried_fraction"]),
                hidden=1.0 - float(own["visible_fraction"]),
                values=rock.quantities,
                truths=_truths(own, alone[true - 1][number]),
                observables=rock.observables,
            )


def _readings(
    spec: SceneSpec, view: RenderedView, capture: Capture, ways: Sequence[Way]
) -> Iterator[tuple[Way, int, Rock]]:
    """Yield what is measured of a view's rocks in each way, with the rocks' true numbers."""
    ranges = {"none": view.depth_m, NOISE: capture.depth_m, NO_RANGE: None}
    true = view.labels.astype(np.int32)
    for way in ways:
        labels = true if way.finder is None else None
        found = _measured(spec, capture, ranges[way.range_kind], labels=labels, find=way.finder)
        rocks = {rock.number: rock for rock in found}
        for match in match_labels(true, found.labels, min_iou=MIN_IOU):
            yield way, match.truth, rocks[match.measured]


def _alone(spec: SceneSpec, scene: SceneModel, rock: PlacedRock) -> list[Rock | None]:
    """What is measured of one rock of a scene in each view without the others; None if nothing."""
    taken = _views(spec, replace(scene, rocks=(rock,)))
    return [
        next(iter(_measured(spec, capture, capture.depth_m, labels=view.labels)), None)
        for view, capture in taken
    ]


def _views(spec: SceneSpec, scene: SceneModel) -> Iterator[tuple[RenderedView, Capture]]:
    """Yield each view of a scene, exact and as the sensor takes it."""
    stage = spec_stage(spec, 0, scene)
    renderer = open_renderer(choose_backend(spec.renderer), stage, scene.camera)
    for number in range(VIEWS):
        yield capture_frame(spec, 0, number, scene=scene, stage=stage, renderer=renderer)


def _measured(
    spec: SceneSpec,
    capture: Capture,
    range_m: NDArray[np.floating] | None,
    *,
    labels: NDArray[np.integer] | None,
    find: str | None = None,
) -> rockshape.Measurement:
    return rockshape.measure(
        capture.picture,
        range_m=range_m,
        camera=None if range_m is None else camera_of(spec.camera),
        labels=labels,
        find=find,
        method=UNESTIMATED,
    )


def _truths(told: dict[Hashable, Any], reference: Rock | None) -> dict[str, float]:
    """True value of each column; NaN where neither the truth nor the fine camera has it."""
    known = {name: float("nan") for name in (*(one.column for one in ROBUST.measures), *AXES)}
    if reference is not None and not reference.truncated:
        known |= reference.values
    same = OF_ROCK | (OF_OUTLINE if told["buried_fraction"] <= MOST_BURIED else {})
    return known | {name: float(told[column]) for name, column in same.items() if column in told}
