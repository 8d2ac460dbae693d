"""One scene of a designed experiment: seen in every cell, measured in three states."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from rockshape.measurement import to_frame
from rockshape.method import find_method
from rockshape.observation import Observation
from rockshape.pipeline import measure
from synth.dataset.shape_truth import scene_gt_shape
from synth.light import light_scene
from synth.light.colour import luminance
from synth.render import choose_backend, open_renderer, render_view
from synth.render.view import RenderedView
from synth.sensor import capture_view
from synth.sensor.rig import rig_of
from synth.spec import SceneSpec
from validation.execution.units import Unit, UnitResult
from validation.execution.views import SceneView, captured_view, with_eligibility
from validation.kinds.design.placement import near_spec, scenes_of
from validation.kinds.design.spec import CLEAN, FOUND, NOISY, DesignExperiment
from validation.records.join import RecordKey, join
from validation.records.match import match_labels
from validation.records.truth import as_scene_truth

REFERENCE = "paper"

TRUTHS = ("truth_outline_axis_ratio", "truth_outline_roundness", "truth_outline_angularity")


@dataclass(frozen=True, eq=False)
class Shot:
    """What the camera took in one cell."""

    view: SceneView
    distance: int
    sun: int
    roll: int
    truth: pd.DataFrame  # one row a rock, with what counts as seen whole


def run(unit: Unit[DesignExperiment]) -> UnitResult:
    """Measure a scene's rocks in every cell.

    The series is the state: `clean` (true masks and exact range; under the first sun alone, since
    neither knows of light), `found` (masks found, exact range), `noisy` (masks found, range as
    measured).
    """
    spec = near_spec(unit.experiment, unit.scene)
    tables = [_measured(unit, shot) for shot in shots(spec, unit.experiment)]
    return UnitResult(pd.concat(tables, ignore_index=True), (), choose_backend(spec.renderer))


def shots(spec: SceneSpec, experiment: DesignExperiment) -> Iterator[Shot]:
    """Every cell's shot; each has chances of its own for its sensor."""
    backend = choose_backend(spec.renderer)
    number = 0
    for distance, rolled in enumerate(scenes_of(spec, experiment)):
        stages = [light_scene(rolled[0], sun, spec.surface) for sun in experiment.suns]
        renderer = open_renderer(backend, stages[0], rolled[0].camera)
        for roll, placed in enumerate(rolled):
            lens = placed.camera
            seen = [
                render_view(renderer, stages[0], lens, pose, supersample=spec.camera.supersample)
                for pose in placed.poses
            ]
            truth = as_scene_truth(scene_gt_shape(placed, 1, seen))
            for view, (pose, first) in enumerate(zip(placed.poses, seen, strict=True)):
                for sun, stage in enumerate(stages):
                    light = first.light
                    if sun > 0:
                        light = luminance(
                            stage.painter.paint(
                                lens,
                                pose,
                                first.labels,
                                first.depth_m,
                                supersample=spec.camera.supersample,
                            )
                        )
                    capture = capture_view(
                        _under(first, light),
                        pose,
                        spec=spec,
                        scene=0,
                        number=number,
                        camera=lens,
                        stage=stage,
                        renderer=renderer,
                    )
                    number += 1
                    taken = captured_view(view, lens, first, capture, truth)
                    yield Shot(taken, distance, sun, roll, _truth(taken, experiment, first))


def _under(view: RenderedView, light: NDArray[np.float32]) -> RenderedView:
    image = np.rint(255.0 * np.clip(light, 0.0, 1.0)).astype(np.uint8)
    return replace(view, light=light, image=image)


def _truth(view: SceneView, experiment: DesignExperiment, rendered: RenderedView) -> pd.DataFrame:
    """One row a rock; `eligible` rocks are seen whole by both eyes.

    Nothing but the causes in question may move them, and a rock that the frame, another rock or
    the edge of the right eye's frame cuts has another outline.
    """
    disparity_px = rig_of(experiment.scene.camera.preset).disparity_px(rendered.depth_m)
    outside = np.arange(disparity_px.shape[1]) < disparity_px
    rocks = len(view.truth)
    cut = np.bincount(rendered.labels.ravel(), outside.ravel(), minlength=rocks + 1)[1:]
    whole = with_eligibility(view.truth, min_visible_fraction=experiment.min_visible_fraction)
    truth: pd.DataFrame = whole[["instance", *TRUTHS]].assign(
        eligible=whole["eligible"] & (cut == 0)
    )
    return truth


def _measured(unit: Unit[DesignExperiment], shot: Shot) -> pd.DataFrame:
    experiment, view = unit.experiment, shot.view
    exact, noisy = view.observation(view.exact_m), view.observation(view.points_m)
    tables = []
    for state, observation in {CLEAN: exact, FOUND: exact, NOISY: noisy}.items():
        if state == CLEAN and shot.sun > 0:
            continue
        for method in experiment.methods:
            labels = view.instances if state == CLEAN else None
            if state != CLEAN and method == REFERENCE:
                labels = true_rocks(observation, view.instances, min_iou=experiment.min_iou)
            found = measure(observation, method=method, labels=labels)
            place = RecordKey(
                experiment=experiment.name,
                kind="design",
                series=state,
                scene=unit.scene,
                seed=experiment.seed + unit.scene,
                view=view.number,
                method=method,
            )
            columns = ["rock", *(m.column for m in find_method(method).measures), "reason"]
            rows = join(
                place,
                shot.truth,
                view.instances,
                found.labels,
                to_frame(found)[columns],
                min_iou=experiment.min_iou,
            )
            tables.append(rows[rows["status"] != "extra"])
    whole = pd.concat(tables, ignore_index=True)
    return whole.assign(distance=shot.distance, sun=shot.sun, roll=shot.roll)


def true_rocks(
    observation: Observation, instances: NDArray[np.int32], *, min_iou: float
) -> NDArray[np.int32]:
    """Rocks that the published method finds, (rows, cols), without detections that are no rock.

    From noisy range it takes hundreds of bumps of the noise for rocks; each would be measured for
    nothing. Its measures read a rock's mask, its range and the ground's plane, which are the same
    without the others.
    """
    labels = find_method(REFERENCE).segment(observation).labels
    rocks = [match.measured for match in match_labels(instances, labels, min_iou=min_iou)]
    return np.where(np.isin(labels, rocks), labels, 0)
