"""Angularity of rocks over views beside what the exact outline of each view tells."""

from collections.abc import Iterator

import msgspec
import numpy as np
import pandas as pd
from case import Cell, Column, Table
from limit_scores import Scored, score_cells, score_columns, scored
from suites import chosen_suite

from rockshape.measures import angularity_2d
from rockshape.measures.angularity_2d import angularity_beyond_form
from rockshape.numerics.arrays import Floats
from rockshape.outline.form import form_of
from rockshape.rock.view import RockView
from synth.camera.projection import project
from synth.geometry.mesh import Mesh
from synth.rocks.outlines import mesh_form
from synth.scene.scene import SceneModel, build_scene
from validation.execution.units import units_of
from validation.execution.work import run_unit
from validation.kinds.multiview.spec import MultiviewExperiment
from validation.scores.blocks import blocks_of
from validation.scores.expectations import Claim
from validation.statistics import Block

OURS = angularity_2d.ROBUST.column
EXACT = "exact_outline"
FINER = {"exact_outline_half": 0.06, "exact_outline_quarter": 0.03}  # scale of the form
WADELL = "truth_outline_angularity"
READINGS = {
    OURS: "`angularity_2d` of the outline found",
    EXACT: "`angularity_2d` of the view's exact outline",
    **{name: f"the same at a scale of {share:g}" for name, share in FINER.items()},
    WADELL: "1 less Wadell's roundness of the exact outline, at no scale",
}
MEAN = "`angularity_2d` of the exact outlines, mean of the views"
STATISTICS = {
    "cv": "CV over views",
    "within_over_between": "SD within over between",
    "slope": "slope",
    "pairs_across": "pairs in order",
}
Scores = dict[tuple[str, str], Scored]  # by statistic and reading


def outline_scores(*, scenes: int, preset: str) -> Scores:
    """Statistics of each reading over views, on the yard of suite `yard`."""
    suite = chosen_suite("yard", only=("yard",), preset=preset)
    records = pd.concat([_read(unit) for unit in units_of(suite)[:scenes]], ignore_index=True)
    blocks = {
        name: blocks_of(records, Claim("yard", "", "robust", name, "truth_angularity"))
        for name in READINGS
    }
    found = {
        (statistic, READINGS[name]): scored(statistic, some, name=f"yard.robust.{name}")
        for statistic in STATISTICS
        for name, some in blocks.items()
    }
    means = [_mean(block) for block in blocks[EXACT]]
    found["pairs_across", MEAN] = scored("pairs_across", means, name="yard.robust.mean")
    return found


def outline_table(found: Scores) -> Table:
    """Table of the readings."""
    columns = (Column("read"), *score_columns(STATISTICS.values()))
    rows: list[tuple[Cell, ...]] = []
    for name in (*READINGS.values(), MEAN):
        cells = score_cells(found.get((statistic, name)) for statistic in STATISTICS)
        rows.append((name, *cells, found["pairs_across", name].count))
    return Table((*columns, Column("pairs", "", "d")), rows, name="outlines")


def _mean(block: Block) -> Block:
    """Block of one view: the mean of each rock's."""
    return Block(values=np.nanmean(block.values, axis=0, keepdims=True), truth=block.truth)


def _read(unit: object) -> pd.DataFrame:
    """Records of a scene's rocks by `robust`, with the readings of their exact outlines."""
    experiment: MultiviewExperiment = unit.experiment
    spec = experiment.scene_at(unit.series)
    spec = msgspec.structs.replace(spec, seed=experiment.seed + unit.scene)
    records = run_unit(unit).records
    exact = pd.DataFrame(list(_exact(build_scene(spec, 0))))
    return records[records["method"] == "robust"].merge(exact, on=["view", "instance"], how="left")


def _exact(scene: SceneModel) -> Iterator[dict[str, float]]:
    for view in range(len(scene.poses)):
        for instance in range(len(scene.rocks)):
            outline_px = exact_outline_px(scene, view, instance)
            rock = RockView(mask=np.ones((1, 1), dtype=np.bool_), subpixel_px=outline_px)
            values = {EXACT: angularity_2d.ROBUST.read(rock).value}
            for name, share in FINER.items():
                form = form_of(outline_px, staircase=False, share=share)
                values[name] = float("nan") if form is None else angularity_beyond_form(form)
            yield {"view": view, "instance": instance, **values}


def exact_outline_px(scene: SceneModel, view: int, instance: int) -> Floats:
    """Outline (n, 2) of a rock in a view, in pixels from its centroid's: its mesh projected."""
    rock, pose = scene.rocks[instance], scene.poses[view]
    points_m = pose.camera_points_m(rock.mesh.vertices_m)
    centre_px = project(scene.camera, pose.camera_points_m(rock.position_m))
    flat = np.column_stack([project(scene.camera, points_m) - centre_px, points_m[:, 2]])
    seen = Mesh(vertices_m=flat, faces=rock.mesh.faces, normals=rock.mesh.normals)
    return mesh_form(seen).silhouette_points_m(np.eye(3)[:2])
