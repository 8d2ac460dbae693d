"""One scene of a fused experiment: measured in every view, and fused under each kind of pose."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace

import msgspec
import numpy as np
import pandas as pd

from rockshape.fusion.fusion import Fusion, fuse_views
from rockshape.fusion.pose import CameraPose
from rockshape.fusion.posed_view import PosedView, posed_view
from rockshape.measurement import to_frame
from rockshape.pipeline import measure
from validation.execution.units import Unit, UnitResult
from validation.execution.views import SceneView, dataset_views, with_eligibility
from validation.kinds.fused.spec import ALONE, EXACT, FUSED, REFINED, FusedExperiment
from validation.records.join import RecordKey, join

ROCK_TRUTHS = (
    "truth_axis_a_m",
    "truth_axis_b_m",
    "truth_axis_c_m",
    "truth_maximum_projection_sphericity",
)


@dataclass(frozen=True, eq=False)
class SceneViews:
    """Views of a scene as measured, their reported and true poses, and the truth about each."""

    views: tuple[PosedView, ...]  # with the reported poses
    true_poses: tuple[CameraPose, ...]
    shown: tuple[SceneView, ...]
    truths: tuple[pd.DataFrame, ...]  # one row a rock, with the column `eligible`

    def fused(self, poses: str) -> Fusion:
        """Views fused under poses of a kind in FUSED."""
        views = self.views
        if poses == EXACT:
            views = tuple(
                view.posed(pose) for view, pose in zip(views, self.true_poses, strict=True)
            )
        return fuse_views(views, refine=poses == REFINED)


def run(unit: Unit[FusedExperiment]) -> UnitResult:
    """Make a scene, measure its views and fuse them."""
    experiment = unit.experiment
    spec = msgspec.structs.replace(experiment.scene, seed=experiment.seed + unit.scene)
    shown, backend = dataset_views(spec)
    tables = []
    for method in experiment.methods:
        scene = scene_views(
            shown, method=method, min_visible_fraction=experiment.min_visible_fraction
        )
        place = RecordKey(experiment.name, "fused", ALONE, unit.scene, spec.seed, 0, method)
        tables += [_alone(place, scene, number) for number in range(len(scene.views))]
        tables += [
            _together(replace(place, series=poses), scene, scene.fused(poses)) for poses in FUSED
        ]
    return UnitResult(pd.concat(tables, ignore_index=True), pictures=(), backend=backend)


def scene_views(
    shown: Sequence[SceneView], *, method: str, min_visible_fraction: float
) -> SceneViews:
    """Views of a dataset measured on true masks; a rock's instance + 1 is its number in each."""
    views, true_poses = [], []
    for view in shown:
        if view.reported_pose is None or view.true_pose is None:
            raise ValueError(f"view {view.number}: expected a dataset's view, found a capture")
        measured = measure(view.observation(view.points_m), method=method, labels=view.instances)
        views.append(posed_view(f"view {view.number}", view.reported_pose, measured))
        true_poses.append(view.true_pose)
    return SceneViews(
        views=tuple(views),
        true_poses=tuple(true_poses),
        shown=tuple(shown),
        truths=tuple(
            with_eligibility(view.truth, min_visible_fraction=min_visible_fraction)
            for view in shown
        ),
    )


def _alone(place: RecordKey, scene: SceneViews, number: int) -> pd.DataFrame:
    """Records of one view by itself."""
    measured, instances = scene.views[number].measurement, scene.shown[number].instances
    return join(
        replace(place, view=number),
        scene.truths[number],
        instances,
        measured.labels,
        to_frame(measured),
        min_iou=0.5,
    )


def _together(place: RecordKey, scene: SceneViews, fusion: Fusion) -> pd.DataFrame:
    """Records of the views as one: a row a true rock that counts in two views or more.

    It is matched by a fused rock that has all its sights and no other rock's.
    """
    counted = pd.concat(scene.truths).groupby("instance")["eligible"].sum()
    truth = scene.truths[0][["instance", *ROCK_TRUTHS]]
    truth = truth.assign(eligible=truth["instance"].map(counted).to_numpy() >= 2)
    partners = pd.DataFrame(_partners(fusion), columns=["instance", "rock"], dtype="Int64")
    rows = truth.astype({"instance": "Int64"}).merge(partners, on="instance", how="left")
    matched = rows["rock"].notna()
    rows["iou"] = np.where(matched, 1.0, np.nan)
    rows["status"] = np.where(matched, "matched", "missed")
    rows = rows.merge(fusion.to_frame(), on="rock", how="left")
    where = pd.DataFrame(asdict(place), index=rows.index)
    return pd.concat([where, rows], axis=1)


def _partners(fusion: Fusion) -> list[tuple[int, int]]:
    """Instance of each true rock and number of the fused rock that has all its sights alone."""
    sights = Counter(rock.rock.number for view in fusion.views for rock in view.rocks)
    partners = []
    for rock in fusion.rocks:
        seen = {fusion.views[each.view].rocks[each.rock].rock.number for each in rock.sights}
        if len(seen) == 1 and len(rock.sights) == sights[min(seen)]:
            partners.append((min(seen) - 1, rock.number))
    return partners
