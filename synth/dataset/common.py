"""Files that belong to all scenes of a dataset; the manifest, written last, seals it."""

from concurrent.futures import Executor
from importlib.metadata import version
from pathlib import Path
from typing import Any

import msgspec

from synth.camera.calibration import calibrated, reported_camera
from synth.camera.trajectories import camera_of
from synth.dataset import bop
from synth.dataset.contact_sheet import MAX_SCENES, sheet_row, write_contact_sheet
from synth.dataset.depth import depth_scale_mm
from synth.dataset.files import read_json, sha256, write_json
from synth.dataset.layout import PARTIAL, scene_path
from synth.dataset.range_files import hole_table
from synth.dataset.splits import write_splits
from synth.spec import RendererName, SceneSpec

_DISTRIBUTIONS = ("rockshape", "numpy", "scipy", "trimesh", "opencv-python-headless", "embreex")
_BACKEND_DISTRIBUTION = {"osmesa": "arcade-pyrender", "egl": "arcade-pyrender", "embree": "embreex"}


def write_common(
    spec: SceneSpec, backend: RendererName, out: Path, pool: Executor | None = None
) -> None:
    """Write camera.json, models_info.json, contact sheet, splits' files and, last, the manifest.

    With a pool its processes draw the sheet, row by row.
    """
    scenes = [out / scene_path(spec, index) for index in range(min(spec.scenes, MAX_SCENES))]
    rows = (map if pool is None else pool.map)(sheet_row, scenes)
    camera = camera_of(spec.camera)
    reported, scale_mm = reported_camera(spec, camera), depth_scale_mm(spec)
    write_json(out / "camera.json", {**bop.camera_table(reported, scale_mm), **hole_table(spec)})
    if calibrated(spec):
        write_json(out / "camera_gt.json", bop.camera_table(camera, scale_mm))
    models: dict[str, Any] = {}
    for index in range(spec.scenes):
        for rock in read_json(out / scene_path(spec, index) / "scene_gt_shape.json")["rocks"]:
            models[str(rock["obj_id"])] = rock["model_mm"]
    write_json(out / "models" / "models_info.json", models)
    write_contact_sheet(out / "contact_sheet.png", list(rows))
    write_splits(spec, out, pool)
    manifest = {**identity(spec, backend), "files": file_digests(out)}
    draft = out / "manifest.draft"
    write_json(draft, manifest)
    draft.replace(out / "manifest.json")


def file_digests(out: Path) -> dict[str, str]:
    """SHA-256 of every file of a dataset but its manifest, by path in rising order."""
    paths = (path for path in out.rglob("*") if path.is_file())
    names = sorted(path.relative_to(out).as_posix() for path in paths)
    own = ("manifest.json", "manifest.draft")
    return {
        name: sha256(out / name)
        for name in names
        if name not in own and not name.startswith(f"{PARTIAL}/")
    }


def identity(spec: SceneSpec, backend: RendererName) -> dict[str, Any]:
    """Identity of a dataset, on which its bytes depend: spec, backend and versions."""
    names = (*_DISTRIBUTIONS, _BACKEND_DISTRIBUTION[backend])
    return {
        "spec": msgspec.to_builtins(spec),
        "seed": spec.seed,
        "backend": backend,
        "versions": {name: version(name) for name in names},
    }
