"""Form from one side beside what could be told with the true outline and the true far side."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from case import Case, Cell, Column, Table
from cases.solids import SCANS, SEED
from numpy.typing import NDArray
from scipy.stats import kendalltau
from views import MadeView, made_views

from rockshape.ground.plane import fit_plane
from rockshape.method import find_method
from rockshape.observation import Observation
from rockshape.pipeline import measure
from rockshape.rock.instances import Instances
from rockshape.rock.view import RockView
from synth.camera.pose import Pose
from synth.geometry.mesh import Mesh
from synth.geometry.min_volume_box import smallest_box
from synth.rocks.truth import maximum_projection_sphericity
from synth.scene.scene import build_scene
from synth.spec import convert_spec
from validation.peers.forms import visible_half_axes_m
from validation.records.match import match_labels

MIN_VISIBLE = 0.8
FORM = {"b_over_a": [0.5, 1.0], "c_over_b": [0.4, 1.0]}
MADE = ("rounded-polyhedron", "lumpy", "broken", "vesicular", "slab")
ESTIMATORS = (
    "one value for all, their median",
    "smallest box of the visible points and their feet",
    "`robust`",
    "`robust`, true mask",
    "smallest box of the visible surface that `robust` has and the true far side",
)
Axes = dict[str, NDArray[np.float64]]  # half-axes (3,) of a rock by estimator


@dataclass(frozen=True, eq=False)
class Sighting:
    """A rock in one view: its true half-axes and those that each estimator gives, (3,)."""

    true_m: NDArray[np.float64]
    found_m: Axes


def limits(
    *,
    count: int = len(SCANS),
    families: int = len(MADE),
    scenes: int = 2,
    scan_views: int = 6,
    preset: str = "msl-navcam",
) -> list[Table]:
    """Errors of each estimator on scanned and made rocks, from exact range and by stereo."""
    scans = {"count": count, "family": "scan", "scans": [str(path) for path in SCANS[:count]]}
    rocks: dict[str, tuple[dict[str, Any], int, int]] = {"scans": (scans, 1, scan_views)}
    for family in MADE[:families]:
        rocks[family] = ({"count": count, "family": family, **FORM}, scenes, 2)
    rows: list[tuple[Cell, ...]] = []
    sets = {
        name: _sightings(table, number, views, preset)
        for name, (table, number, views) in rocks.items()
    }
    made_all = {
        kind: [one for name in list(sets)[1:] for one in sets[name][kind]]
        for kind in ("exact", "stereo")
    }
    for name, kinds in (("scans", sets["scans"]), ("made", made_all)):
        for kind, sightings in kinds.items():
            rows += [(name, kind, one, *_scores(sightings, one)) for one in ESTIMATORS]
    columns = (
        Column("rocks"),
        Column("range"),
        Column("estimator"),
        Column("values"),
        Column("sphericity MAE", "", ".3f"),
        Column("bias", "", "+.3f"),
        Column("τ", "", ".2f"),
        Column("a/b/c error", "%"),
    )
    return [Table(columns, rows)]


def _sightings(
    rocks: dict[str, Any], scenes: int, views: int, preset: str
) -> dict[str, list[Sighting]]:
    """Sightings of the rocks that a view shows, by the kind of range."""
    found: dict[str, list[Sighting]] = {"exact": [], "stereo": []}
    for scene in range(scenes):
        table = {
            "seed": SEED,
            "scenes": scenes,
            "renderer": "embree",
            "rocks": {"series": "random", "spacing": 1.9, **rocks},
            "ground": {"resting": "stable"},
            "camera": {"preset": preset, "distance_m": 4.5, "supersample": 1},
            "views": {"count": views},
            "noise": {"kind": "stereo"},
        }
        spec = convert_spec(table, where="form_limits")
        model = build_scene(spec, scene)
        meshes = [one.mesh for one in model.rocks]
        for view, pose in zip(made_views(spec, scene), model.poses, strict=True):
            found["exact"] += _of_view(view, view.exact, meshes, pose)
            found["stereo"] += _of_view(view, view.observation, meshes, pose)
    return found


def _of_view(
    view: MadeView, seen: Observation, meshes: list[Mesh], pose: Pose
) -> Iterator[Sighting]:
    points_m = np.asarray(seen.points_m)
    plane = fit_plane(points_m[view.labels == 0])
    given = {rock.number: rock.half_axes_m for rock in measure(seen, labels=view.labels)}
    itself = measure(seen)
    partners = {
        match.truth: match.measured
        for match in match_labels(view.labels.astype(np.int32), itself.labels, min_iou=0.5)
    }
    own = {rock.number: rock.half_axes_m for rock in itself}
    ground = find_method("robust").ground(seen)
    for part in Instances.from_labels(view.labels).largest_parts():
        instance = part.id - 1
        if view.seen[instance]["visible_fraction"] < MIN_VISIBLE:
            continue
        rows, cols = part.window
        rock = RockView(
            mask=part.mask,
            corner=(rows.start, cols.start),
            grid_m=points_m[part.window],
            camera=seen.camera,
            ground=ground,
        )
        whole_m = np.concatenate([rock.visible_m, _far_side_m(meshes[instance], pose)])
        half_axes = (
            visible_half_axes_m(points_m[view.labels == part.id], plane),
            _or_nan(own.get(partners.get(part.id, 0))),
            _or_nan(given.get(part.id)),
            smallest_box(whole_m).half_sides_m,
        )
        true_m = np.array(view.rocks[instance]["half_axes_box_m"])
        yield Sighting(true_m, dict(zip(ESTIMATORS[1:], half_axes, strict=True)))


def _far_side_m(mesh: Mesh, pose: Pose) -> NDArray[np.float64]:
    """Vertices, in the camera's frame, of the faces that look away from it: rim and far side."""
    vertices_m = pose.camera_points_m(mesh.vertices_m)
    corners_m = vertices_m[mesh.faces]
    normals = np.cross(corners_m[:, 1] - corners_m[:, 0], corners_m[:, 2] - corners_m[:, 0])
    away = np.einsum("nj,nj->n", normals, corners_m.mean(axis=1)) > 0
    return np.asarray(vertices_m[np.unique(mesh.faces[away])])


def _or_nan(half_axes_m: NDArray[np.float64] | None) -> NDArray[np.float64]:
    return np.full(3, np.nan) if half_axes_m is None else np.asarray(half_axes_m)


def _scores(sightings: list[Sighting], estimator: str) -> list[Cell]:
    """Cells of an estimator's row."""
    true_m = np.array([one.true_m for one in sightings])
    truth = np.array([maximum_projection_sphericity(one) for one in true_m])
    if estimator == ESTIMATORS[0]:
        error = np.median(truth) - truth
        return [
            f"{len(truth)}/{len(truth)}",
            float(np.abs(error).mean()),
            float(error.mean()),
            None,
            None,
        ]
    found_m = np.array([one.found_m[estimator] for one in sightings])
    known = np.isfinite(found_m).all(axis=1)
    values = np.array([maximum_projection_sphericity(one) for one in found_m[known]])
    error = values - truth[known]
    slips = np.abs(found_m[known] / true_m[known] - 1).mean(axis=0)
    tau = float(kendalltau(values, truth[known]).statistic) if len(values) > 1 else None
    return [
        f"{known.sum()}/{len(known)}",
        float(np.abs(error).mean()),
        float(error.mean()),
        tau,
        " / ".join(f"{100 * slip:.0f}" for slip in slips),
    ]


FORM_LIMITS_CASE = Case(
    name="form_limits",
    what="3-D form from one side beside what the true outline and the true far side would tell",
    run=limits,
    smallest={"count": 1, "families": 1, "scenes": 1, "scan_views": 1, "preset": "imp"},
)
