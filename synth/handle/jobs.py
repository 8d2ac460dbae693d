"""Jobs of worker processes: building a scene, rendering one of its views, writing a dataset."""

import pickle
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synth.arrays import ColourImage, DepthImage, Image, LabelImage, NormalImage
from synth.camera.calibration import reported_pose
from synth.camera.pose import Pose
from synth.dataset.depth import decode_depth, depth_scale_mm, encode_depth
from synth.dataset.files import plain
from synth.dataset.generate import generate_dataset
from synth.dataset.layout import first_object_id
from synth.dataset.normals import decode_normals, encode_normals
from synth.dataset.shape_truth import scene_gt_shape
from synth.dataset.write import capture_frame
from synth.light import spec_stage
from synth.render import choose_backend, open_renderer
from synth.scene.scene import SceneModel, build_scene
from synth.sensor import sensor_of
from synth.spec import SceneSpec, truth_of

Rows = list[dict[str, Any]]


@dataclass(frozen=True, eq=False)
class BuiltScene:
    """Built scene, ready to be rendered, and the truth of its rocks."""

    model: bytes  # pickled, for further jobs
    rocks: Rows  # as in scene_gt_shape.json


@dataclass(frozen=True, eq=False)
class ViewParts:
    """Contents of the dataset for one view."""

    image: Image | ColourImage
    normals: NormalImage | None
    depth_m: DepthImage
    exact_depth_m: DepthImage
    labels: LabelImage
    not_rock: NDArray[np.uint8]
    pictures: Mapping[str, Image]
    pose: Pose  # as reported
    exact_pose: Pose
    rocks: Rows  # as in scene_gt_shape.json
    visible: Rows


def build(spec: SceneSpec, index: int) -> BuiltScene:
    """Scene `index` of a spec, without rendering anything.

    Raises:
        SpecError: the rocks do not fit on the ground.
    """
    model = build_scene(spec, index)
    unseen = replace(model, poses=())
    table = scene_gt_shape(unseen, first_object_id(spec, index), [], wanted=truth_of(spec))
    rocks = plain(table["rocks"])
    return BuiltScene(model=pickle.dumps(model), rocks=rocks)


def render(spec: SceneSpec, index: int, number: int, model: bytes) -> ViewParts:
    """View `number` of a built scene, each array as a reader of the dataset has it.

    Raises:
        SpecError: the sensor cannot be used with the spec's camera.
        MissingBackendError: the machine lacks the renderer.
    """
    sensor_of(spec)
    scene: SceneModel = pickle.loads(model)
    stage = spec_stage(spec, index, scene)
    renderer = open_renderer(choose_backend(spec.renderer), stage, scene.camera)
    view, capture = capture_frame(spec, index, number, scene=scene, stage=stage, renderer=renderer)
    scale_mm = depth_scale_mm(spec)
    seen = replace(scene, poses=(scene.poses[number],))
    first_id = first_object_id(spec, index)
    truth = plain(scene_gt_shape(seen, first_id, [view.sight()], wanted=truth_of(spec)))
    grey = {} if capture.colour is None else {"gray": capture.picture}
    return ViewParts(
        image=capture.picture if capture.colour is None else capture.colour,
        normals=None if view.normals is None else decode_normals(encode_normals(view.normals)),
        depth_m=decode_depth(encode_depth(capture.depth_m, scale_mm), scale_mm),
        exact_depth_m=decode_depth(encode_depth(view.depth_m, scale_mm), scale_mm),
        labels=view.labels,
        not_rock=view.not_rock,
        pictures={**grey, **capture.pictures},
        pose=reported_pose(spec, scene.poses[number], scene=index, view=number),
        exact_pose=scene.poses[number],
        rocks=truth["rocks"],
        visible=truth["views"]["0"],
    )


def write(spec: SceneSpec, out: Path, jobs: int) -> None:
    """Dataset of a spec, written into a folder; see `generate_dataset`."""
    generate_dataset(spec, out, jobs=jobs)
