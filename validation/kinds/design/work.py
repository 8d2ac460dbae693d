"""One scene of a designed experiment: seen in every cell, measured in three states."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.measurement import to_frame
from rockshape.method import methods
from rockshape.observation import Observation
from rockshape.pipeline import measure
from synth.camera.camera import RenderCamera as SynthCamera
from synth.dataset.shape_truth import scene_gt_shape
from synth.light import light_scene
from synth.render import choose_backend, open_renderer, render_view
from synth.render.view import RenderedView
from synth.sensor import capture_view
from synth.sensor.rig import rig_of
from synth.spec import SceneSpec
from validation.kinds.design.placement import near_spec, scenes_of
from validation.records.join import RecordKey, join
from validation.records.match import match_labels
from validation.suite.experiments import DesignExperiment

REFERENCE = "paper"
CLEAN, FOUND, NOISY = STATES = ("clean", "found", "noisy")

_TRUTHS = ("outline_axis_ratio", "outline_roundness")


@dataclass(frozen=True, eq=False)
class Shot:
    """What the camera took in one cell."""

    view: int
    distance: int
    sun: int
    roll: int
    image: NDArray[np.float32]  # (rows, cols), 0..1
    exact_m: NDArray[np.float64]  # (rows, cols), z-depth
    noisy_m: NDArray[np.float64]  # (rows, cols), as the stereo camera measures it
    instances: NDArray[np.int32]  # (rows, cols), 1 + the rock's index
    truth: pd.DataFrame  # one row a rock


def run_design(experiment: DesignExperiment, scene: int) -> tuple[pd.DataFrame, str]:
    """Return the records of scene number `scene` and the renderer.

    The series is the state: `clean` (true masks and exact range; under the first sun alone, since
    neither knows of light), `found` (masks found, exact range), `noisy` (masks found, range as
    measured).
    """
    spec = near_spec(experiment, scene)
    tables = [
        _measured(experiment, scene, shot, camera) for shot, camera in shots(spec, experiment)
    ]
    return pd.concat(tables, ignore_index=True), choose_backend(spec.renderer)


def shots(spec: SceneSpec, experiment: DesignExperiment) -> Iterator[tuple[Shot, Camera]]:
    """Yield every cell's shot; each has chances of its own for its sensor."""
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
            table = scene_gt_shape(placed, 0, seen)["views"]
            for view, (pose, first) in enumerate(zip(placed.poses, seen, strict=True)):
                for sun, stage in enumerate(stages):
                    light = first.light
                    if sun > 0:
                        light = stage.painter.paint(
                            lens,
                            pose,
                            first.labels,
                            first.depth_m,
                            supersample=spec.camera.supersample,
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
                    white = np.iinfo(capture.picture.dtype).max
                    shot = Shot(
                        view=view,
                        distance=distance,
                        sun=sun,
                        roll=roll,
                        image=(capture.picture / white).astype(np.float32),
                        exact_m=first.depth_m,
                        noisy_m=capture.depth_m,
                        instances=first.labels.astype(np.int32),
                        truth=_truth(table[str(view)], experiment, first),
                    )
                    yield shot, _camera(lens)


def _under(view: RenderedView, light: NDArray[np.float32]) -> RenderedView:
    image = np.rint(255.0 * np.clip(light, 0.0, 1.0)).astype(np.uint8)
    return replace(view, light=light, image=image)


def _camera(lens: SynthCamera) -> Camera:
    return Camera(lens.fx, lens.fy, lens.cx, lens.cy, lens.width, lens.height)


def _truth(
    rocks: list[dict[str, object]], experiment: DesignExperiment, view: RenderedView
) -> pd.DataFrame:
    """Return one row a rock; `eligible` rocks are seen whole by both eyes.

    Nothing but the causes in question may move them, and a rock that the frame, another rock or
    the edge of the right eye's frame cuts has another outline.
    """
    disparity_px = rig_of(experiment.scene.camera.preset).disparity_px(view.depth_m)
    outside = np.arange(disparity_px.shape[1]) < disparity_px
    cut = np.bincount(view.labels.ravel(), outside.ravel(), minlength=len(rocks) + 1)[1:]
    table = pd.DataFrame(rocks)
    whole = (table["visible_fraction"] >= experiment.min_visible_fraction) & (cut == 0)
    truth = table[["instance", *_TRUTHS]].rename(
        columns={name: f"truth_{name}" for name in _TRUTHS}
    )
    return truth.assign(eligible=whole & ~table["truncated"].astype(bool))


def _measured(experiment: DesignExperiment, scene: int, shot: Shot, camera: Camera) -> pd.DataFrame:
    exact = Observation(image=shot.image, points_m=camera.unproject(shot.exact_m), camera=camera)
    noisy = replace(exact, points_m=camera.unproject(shot.noisy_m))
    tables = []
    for state, observation in {CLEAN: exact, FOUND: exact, NOISY: noisy}.items():
        if state == CLEAN and shot.sun > 0:
            continue
        for method in experiment.methods:
            labels = shot.instances if state == CLEAN else None
            if state != CLEAN and method == REFERENCE:
                labels = true_rocks(observation, shot.instances, min_iou=experiment.min_iou)
            found = measure(observation, method=method, labels=labels)
            place = RecordKey(
                experiment=experiment.name,
                kind="design",
                series=state,
                scene=scene,
                seed=experiment.seed + scene,
                view=shot.view,
                method=method,
            )
            columns = ["rock", *(m.column for m in methods()[method].measures), "reason"]
            rows = join(
                place,
                shot.truth,
                shot.instances,
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
    """Return what the published way finds, (rows, cols), without what is no rock.

    From noisy range it takes hundreds of bumps of the noise for rocks; each would be measured for
    nothing. Its measures read a rock's mask, its range and the ground's plane, which are the same
    without the others.
    """
    labels = methods()[REFERENCE].segment(observation).labels
    rocks = [match.measured for match in match_labels(instances, labels, min_iou=min_iou)]
    return np.where(np.isin(labels, rocks), labels, 0)
