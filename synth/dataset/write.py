"""Scene writing: one scene of a dataset, complete or not at all."""

import os
import shutil
from contextlib import nullcontext
from pathlib import Path

import numpy as np
from msgspec import UNSET

from synth.camera.calibration import calibrated, reported_camera, reported_pose
from synth.dataset import bop
from synth.dataset.depth import depth_scale_mm, encode_depth
from synth.dataset.files import (
    write_ascii_ply_mm,
    write_json,
    write_ply_mm,
    write_png,
    write_rgb_png,
)
from synth.dataset.glb import scene_glb
from synth.dataset.layout import (
    PARTIAL,
    first_object_id,
    has_things,
    image_folders,
    layout_of,
    model_origins_m,
    picture_folder,
    scene_number,
    scene_path,
)
from synth.dataset.normals import encode_normals
from synth.dataset.range_files import RANGE_FOLDER, hole_value, write_range
from synth.dataset.shape_truth import scene_gt_shape
from synth.dataset.surroundings import light_table, things_table
from synth.dataset.view_files import write_masks, write_pictures
from synth.dataset.workers import begin_scene, worker_pool
from synth.light import Stage, spec_stage
from synth.light.drawn_sun import drawn_sun
from synth.progress import counted
from synth.render import RenderedView, open_renderer, render_view
from synth.render.interface import Renderer
from synth.render.view import Sight
from synth.scene.scene import SceneModel, build_scene
from synth.sensor import Capture, capture_view, sensor_of
from synth.spec import RendererName, SceneSpec, image_of, truth_of


def write_scene(
    spec: SceneSpec, index: int, backend: RendererName, out: Path, *, jobs: int = 1
) -> str:
    """Scene built, rendered and written into a dataset's folder; its folder's name.

    With several jobs so many further processes make rocks, and so many threads write masks. This
    is the unit of work: it needs nothing but its arguments and may run in any process. The scene is
    written apart, in a folder of this process's own, and renamed into place when whole, after its
    models: a process that outlives its run disturbs no other.
    """
    sensor = sensor_of(spec)
    begin_scene(scene_number(index))
    with worker_pool(jobs) if jobs > 1 else nullcontext() as pool:
        scene = build_scene(spec, index, pool=pool)
    stage = spec_stage(spec, index, scene)
    renderer = open_renderer(backend, stage, scene.camera)
    scale_mm = depth_scale_mm(spec)
    folder = out / PARTIAL / f"{scene_number(index)}.{os.getpid()}"
    shutil.rmtree(folder, ignore_errors=True)
    ranges = () if hole_value(spec) is None else (RANGE_FOLDER,)
    added = (*ranges, *image_folders(spec))
    for name in (*sensor.folders(), *added, "labels", "mask", "mask_visib", "models"):
        (folder / name).mkdir(parents=True)
    views: list[Sight] = []
    valid = []
    for number in counted(range(len(scene.poses)), "views"):
        view, capture = capture_frame(
            spec, index, number, scene=scene, stage=stage, renderer=renderer
        )
        depth = encode_depth(capture.depth_m, scale_mm)
        write_pictures(folder, number, capture, depth)
        write_range(folder, number, capture.depth_m, hole_value(spec))
        if not sensor.exact_range:
            exact = encode_depth(view.depth_m, scale_mm)
            write_png(folder / "depth_true" / f"{number:06d}.png", exact)
        if has_things(spec):
            write_png(folder / "not_rock" / f"{number:06d}.png", view.not_rock)
        if view.normals is not None:
            normals = encode_normals(view.normals)
            write_rgb_png(folder / "normals" / f"{number:06d}.png", normals)
        write_masks(folder, number, view, jobs)
        views.append(view.sight())
        valid.append(depth > 0)
    first_id = first_object_id(spec, index)
    origins_m = model_origins_m(spec, scene)
    models = [
        placed.rock.mesh.moved(np.eye(3), -origin_m) if origin_m.any() else placed.rock.mesh
        for placed, origin_m in zip(scene.rocks, origins_m, strict=True)
    ]
    tables = {
        **_camera_tables(spec, index, scene, scale_mm),
        "gt": bop.scene_gt(scene, first_id, origins_m),
        "gt_info": bop.scene_gt_info(scene, views, valid),
        "gt_coco": bop.scene_gt_coco(scene, index, first_id, views, pictures=picture_folder(spec)),
        "gt_shape": scene_gt_shape(scene, first_id, views, models=models, wanted=truth_of(spec)),
    }
    if has_things(spec):
        tables["things"] = things_table(scene)
    if spec.light is not UNSET:
        tables["light"] = light_table(drawn_sun(spec, index))
    for name, table in tables.items():
        write_json(folder / f"scene_{name}.json", table)
    (folder / "scene.glb").write_bytes(scene_glb(stage))
    for instance, model in enumerate(models):
        place = folder / "models" / f"obj_{first_id + instance:06d}.ply"
        (write_ascii_ply_mm if layout_of(spec).ascii_models else write_ply_mm)(place, model)
    _publish(folder, out, out / scene_path(spec, index))
    return scene_number(index)


def capture_frame(
    spec: SceneSpec,
    index: int,
    number: int,
    *,
    scene: SceneModel,
    stage: Stage,
    renderer: Renderer,
) -> tuple[RenderedView, Capture]:
    """View `number` of scene `index`: as it is rendered exactly, and as the sensor captures it."""
    pose, supersample = scene.poses[number], spec.camera.supersample
    view = render_view(
        renderer,
        stage,
        scene.camera,
        pose,
        supersample=supersample,
        normals=image_of(spec).normals,
    )
    capture = capture_view(
        view,
        pose,
        spec=spec,
        scene=index,
        number=number,
        camera=scene.camera,
        stage=stage,
        renderer=renderer,
    )
    return view, capture


def _camera_tables(
    spec: SceneSpec, index: int, scene: SceneModel, scale_mm: float
) -> dict[str, bop.Table]:
    """Tables of the cameras as reported and, where that is not exact, as they are."""
    reported = [
        reported_pose(spec, pose, scene=index, view=view) for view, pose in enumerate(scene.poses)
    ]
    camera = reported_camera(spec, scene.camera)
    tables = {"camera": bop.scene_camera(camera, reported, scale_mm)}
    if calibrated(spec):
        tables["gt_camera"] = bop.scene_camera(scene.camera, scene.poses, scale_mm)
    return tables


def _publish(folder: Path, out: Path, place: Path) -> None:
    """Move a whole scene into place: its models first, the folder's renaming seals it."""
    models = out / "models"
    models.mkdir(exist_ok=True)
    for path in sorted((folder / "models").iterdir()):
        path.replace(models / path.name)
    (folder / "models").rmdir()
    place.parent.mkdir(exist_ok=True)
    folder.replace(place)
