"""Form of rocks from one view and from four fused: made scenes, poses exact, off and refined."""

import json
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from case import Case, Cell, Column, Table

from rockshape.camera.camera import Camera
from rockshape.fusion.fusion import Fusion, fuse_views
from rockshape.fusion.pose import CameraPose
from rockshape.fusion.posed_view import PosedView, posed_view
from rockshape.io import read_camera, read_image, read_range
from rockshape.observation import Observation
from rockshape.pipeline import measure
from synth.dataset.common import write_common
from synth.dataset.write import write_scene
from synth.render import choose_backend
from synth.spec import convert_spec
from validation.records.truth import read_instances

# held out: the form was developed on apollo_sample 1, 3, 4, 7, 8 and 17
SCANS = tuple(
    sorted(str(each) for each in (Path(__file__).parents[2] / "examples" / "rocks").glob("*.ply"))
)
SEED = 10_000
STEREO = {"kind": "stereo"}
RUNS: tuple[tuple[str, Mapping[str, Any]], ...] = (
    ("scans, exact range", {"rocks": {"family": "scan", "scans": SCANS}}),
    ("scans, stereo", {"rocks": {"family": "scan", "scans": SCANS}, "noise": STEREO}),
)


@dataclass(frozen=True, eq=False)
class Scene:
    """Views as measured with the poses reported, the poses that are true, and the true rocks."""

    views: list[PosedView]
    exact: list[CameraPose]
    sphericity: dict[int, float]  # by the label


def form_of_fused_rocks(
    *, runs: tuple[tuple[str, Mapping[str, Any]], ...] = RUNS, scenes: int = 1
) -> list[Table]:
    """Fuse scenes of six rocks from four sides, with true masks."""
    rows: list[tuple[Cell, ...]] = []
    for name, options in runs:
        made = [_scene(options, SEED + number) for number in range(scenes)]
        single = [error for scene in made for error in _single_errors(scene)]
        rows.append((name, "one view", len(single), None, float(np.mean(np.abs(single)))))
        for poses in ("exact", "given", "refined"):
            found = [(scene, _fused(scene, poses)) for scene in made]
            whole = [_errors(scene, fusion) for scene, fusion in found]
            errors = [each for own in whole for each in own]
            rocks = sum(len(scene.sphericity) for scene in made)
            error = float(np.mean(np.abs(errors))) if errors else None
            rows.append((name, f"four, poses {poses}", len(errors), len(errors) / rocks, error))
    columns = (
        Column("rocks"),
        Column("views"),
        Column("values", "", "d"),
        Column("rocks matched in all four", "", ".2f"),
        Column("sphericity MAE", "", ".3f"),
    )
    return [Table(columns, rows)]


def _fused(scene: Scene, poses: str) -> Fusion:
    views = scene.views
    if poses == "exact":
        views = [view.posed(pose) for view, pose in zip(views, scene.exact, strict=True)]
    return fuse_views(views, refine=poses == "refined")


def _errors(scene: Scene, fusion: Fusion) -> list[float]:
    """Errors of the rocks whose four sights are of one true rock."""
    errors = []
    for rock in fusion.rocks:
        labels = {fusion.views[s.view].rocks[s.rock].rock.number for s in rock.sights}
        if len(labels) == 1 and len(rock.sights) == len(fusion.views):
            errors.append(rock.values["sphericity_3d"].value - scene.sphericity[labels.pop()])
    return errors


def _single_errors(scene: Scene) -> list[float]:
    found = [
        rock.rock.values["sphericity_3d"] - scene.sphericity[rock.rock.number]
        for view in scene.views
        for rock in view.rocks
    ]
    return [each for each in found if np.isfinite(each)]


def _scene(options: Mapping[str, Any], seed: int) -> Scene:
    rocks = {"count": 6, "series": "random", "spacing": 1.9, **options.get("rocks", {})}
    table = {
        "seed": seed,
        "rocks": rocks,
        "ground": {"resting": "stable"},
        "views": {"count": 4},
        "calibration": {"turn_deg": 0.5, "shift_m": 0.01},
        **{key: value for key, value in options.items() if key != "rocks"},
    }
    spec = convert_spec(table, where="fusing")
    with tempfile.TemporaryDirectory() as parent:
        folder, backend = Path(parent) / "data", choose_backend(spec.renderer)
        write_scene(spec, 0, backend, folder)
        write_common(spec, backend, folder)
        data, camera = folder / "000000", read_camera(folder / "camera.json")
        reported, exact = (
            _poses(data / name) for name in ("scene_camera.json", "scene_gt_camera.json")
        )
        views = [_view(data, number, camera, pose) for number, pose in enumerate(reported)]
        truth = json.loads((data / "scene_gt_shape.json").read_text(encoding="utf-8"))
    sphericity = {
        rock["instance"] + 1: rock["maximum_projection_sphericity"] for rock in truth["rocks"]
    }
    return Scene(views, exact, sphericity)


def _poses(path: Path) -> list[CameraPose]:
    """Poses of a BOP scene, in the order of its views."""
    return [
        CameraPose.from_world_to_camera(
            np.reshape(view["cam_R_w2c"], (3, 3)), np.array(view["cam_t_w2c"]) / 1000
        )
        for view in json.loads(path.read_text(encoding="utf-8")).values()
    ]


def _view(data: Path, number: int, camera: Camera, pose: CameraPose) -> PosedView:
    name = f"{number:06d}.png"
    image = read_image(data / "gray" / name)
    points_m = read_range(data / "depth" / name, shape=image.shape, camera=camera)
    labels = read_instances(data / "labels" / name)
    observation = Observation(image=image, points_m=points_m, camera=camera)
    return posed_view(f"view {number}", pose, measure(observation, labels=labels))


FUSING_CASE = Case(
    name="fusing",
    what="form of rocks from one view and from four fused, by poses",
    run=form_of_fused_rocks,
    smallest={"runs": RUNS[:1], "scenes": 1},
)
