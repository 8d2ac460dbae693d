"""Form of rocks from one view and from four fused: made scenes, poses exact, off and refined."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from case import Case, Cell, Column, Table

from rockshape.fusion.fusion import Fusion
from synth.spec import convert_spec
from validation.execution.views import dataset_views
from validation.kinds.fused.spec import EXACT, GIVEN, REFINED
from validation.kinds.fused.work import SceneViews, scene_views

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


def form_of_fused_rocks(
    *, runs: tuple[tuple[str, Mapping[str, Any]], ...] = RUNS, scenes: int = 1
) -> list[Table]:
    """Fuse scenes of six rocks from four sides, with true masks."""
    rows: list[tuple[Cell, ...]] = []
    for name, options in runs:
        made = [_scene(options, SEED + number) for number in range(scenes)]
        single = [error for scene in made for error in _single_errors(scene)]
        rows.append((name, "one view", len(single), None, float(np.mean(np.abs(single)))))
        for poses in (EXACT, GIVEN, REFINED):
            found = [(scene, scene.fused(poses)) for scene in made]
            whole = [_errors(scene, fusion) for scene, fusion in found]
            errors = [each for own in whole for each in own]
            rocks = sum(len(scene.truths[0]) for scene in made)
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


def _errors(scene: SceneViews, fusion: Fusion) -> list[float]:
    """Errors of the rocks whose four sights are of one true rock."""
    truth = _sphericity(scene)
    errors = []
    for rock in fusion.rocks:
        labels = {fusion.views[s.view].rocks[s.rock].rock.number for s in rock.sights}
        if len(labels) == 1 and len(rock.sights) == len(fusion.views):
            errors.append(rock.values["sphericity_3d"].value - truth[labels.pop()])
    return errors


def _single_errors(scene: SceneViews) -> list[float]:
    truth = _sphericity(scene)
    found = [
        rock.rock.values["sphericity_3d"] - truth[rock.rock.number]
        for view in scene.views
        for rock in view.rocks
    ]
    return [each for each in found if np.isfinite(each)]


def _sphericity(scene: SceneViews) -> dict[int, float]:
    """True sphericity by the label."""
    truth = scene.truths[0]
    return dict(
        zip(truth["instance"] + 1, truth["truth_maximum_projection_sphericity"], strict=True)
    )


def _scene(options: Mapping[str, Any], seed: int) -> SceneViews:
    rocks = {"count": 6, "series": "random", "spacing": 1.9, **options.get("rocks", {})}
    table = {
        "seed": seed,
        "rocks": rocks,
        "ground": {"resting": "stable"},
        "views": {"count": 4},
        "calibration": {"turn_deg": 0.5, "shift_m": 0.01},
        **{key: value for key, value in options.items() if key != "rocks"},
    }
    views, _ = dataset_views(convert_spec(table, where="fusing"))
    return scene_views(views, method="robust", min_visible_fraction=0.0)


FUSING_CASE = Case(
    name="fusing",
    what="form of rocks from one view and from four fused, by poses",
    run=form_of_fused_rocks,
    smallest={"runs": RUNS[:1], "scenes": 1},
)
