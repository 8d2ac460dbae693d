"""3-D measures against truth: made rocks by series and distance, and scans from many sides."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from case import Case, Cell, Column, Table
from numpy.typing import NDArray
from scipy.stats import kendalltau
from views import MadeView, made_views

from rockshape.ellipsoid import fit_ellipsoid
from rockshape.measurement import to_frame
from rockshape.measures.sphericity_3d import sphericity_3d
from rockshape.pipeline import measure
from synth.geometry.mesh import Mesh
from synth.rocks.scan import scan
from synth.spec import convert_spec

SCANS = sorted((Path(__file__).parents[2] / "examples" / "rocks").glob("*.ply"))
SEED = 10_000
METHODS = ("paper", "robust")
AXES = ["axis_a_m", "axis_b_m", "axis_c_m"]
# columns of both methods
ELLIPSOID_ERROR = {"paper": "ellipsoid_error_m2", "robust": "ellipsoid_error"}
ANGULARITY = {"paper": "angularity_3d_per_m", "robust": "angularity_3d"}
# scenes, rocks, and the truth that falls or rises with angularity
SERIES: dict[str, tuple[int, dict[str, Any], str]] = {
    "form": (8, {"series": "random", "b_over_a": [0.5, 1.0], "c_over_b": [0.4, 1.0]}, ""),
    "graded": (6, {}, "roundness"),
    "relief": (
        4,
        {
            "series": "relief",
            "relief_rms": [0.002, 0.03],
            "relief_degrees": [8, 20],
            "rounding": [0.3, 0.3],
        },
        "relief_rms_m",
    ),
}
DISTANCES_M = {"form": (3.0, 4.5, 8.0), "graded": (3.0, 4.5), "relief": (4.5,)}
RUNS = tuple((series, m) for series, all_ in DISTANCES_M.items() for m in all_)


def against_truth(
    *, runs: tuple[tuple[str, float], ...] = RUNS, scenes: int = 99, preset: str = "msl-navcam"
) -> list[Table]:
    """Measure each series at its distance with true masks, exact range and stereo noise."""
    rows = []
    for series, distance_m in runs:
        count, rocks, knob = SERIES[series]
        camera = {"preset": preset, "distance_m": distance_m, "supersample": 1}
        found = _measured(rocks, camera, min(count, scenes), knob)
        for (kind, method), records in found.items():
            rows.append((series, distance_m, kind, method, *_scores(records, series, method)))
    columns = (
        Column("series"),
        Column("distance", "m", "g"),
        Column("range"),
        Column("method"),
        Column("ellipsoids"),
        Column("sphericity MAE", "", ".3f"),
        Column("sphericity τ", "", ".2f"),
        Column("a/b/c error", "%"),
        Column("ellipsoid error τ", "", ".2f"),
        Column("measured", "%", ".0f"),
        Column("angularity τ", "", ".2f"),
        Column("measured", "%", ".0f"),
    )
    return [Table(columns, rows)]


def _measured(
    rocks: dict[str, Any], camera: dict[str, Any], scenes: int, knob: str
) -> dict[tuple[str, str], pd.DataFrame]:
    """Return a row for each rock in each view, by range and method, with its truth."""
    found: dict[tuple[str, str], list[pd.DataFrame]] = {}
    for scene in range(scenes):
        table = {
            "seed": SEED,
            "scenes": scenes,
            "renderer": "embree",
            "rocks": {"count": 6, **rocks},
            "camera": camera,
            "views": {"count": 2},
            "noise": {"kind": "stereo"},
        }
        for number, view in enumerate(made_views(convert_spec(table, where="solids"), scene)):
            for key, frame in measured_both(view).items():
                true = [view.rocks[int(rock) - 1] for rock in frame["rock"]]
                frame["true_sphericity"] = [one["maximum_projection_sphericity"] for one in true]
                frame[["true_a", "true_b", "true_c"]] = [one["half_axes_box_m"] for one in true]
                frame["knob"] = [one[knob] if knob else np.nan for one in true]
                found.setdefault(key, []).append(frame.assign(view=2 * scene + number))
    return {key: pd.concat(frames, ignore_index=True) for key, frames in found.items()}


def measured_both(view: MadeView) -> dict[tuple[str, str], pd.DataFrame]:
    """Return the tables of a view's rocks with their true masks, by range and method."""
    return {
        (kind, method): to_frame(measure(seen, method=method, labels=view.labels))
        for kind, seen in (("exact", view.exact), ("stereo", view.observation))
        for method in METHODS
    }


def _scores(records: pd.DataFrame, series: str, method: str) -> list[Cell]:
    """Return the cells of one row of the table."""
    known = records[np.isfinite(records["sphericity_3d"])]
    error = (known["sphericity_3d"] - known["true_sphericity"]).abs().mean()
    axes = known[AXES].to_numpy(float) / known[["true_a", "true_b", "true_c"]].to_numpy(float)
    slips = " / ".join(f"{100 * slip:.0f}" for slip in np.abs(axes - 1).mean(axis=0))
    cells: list[Cell] = [f"{len(known)}/{len(records)}", error]
    if series == "form":
        tau = kendalltau(known["sphericity_3d"], known["true_sphericity"]).statistic
        return [*cells, tau, slips, None, None, None, None]
    cells += [None, slips]
    for column in (ELLIPSOID_ERROR[method], ANGULARITY[method]):
        share = 100 * np.isfinite(records[column].astype(float)).mean()
        cells += [_tau_in_views(records, column, falls=series == "graded"), share]
    return cells


def _tau_in_views(records: pd.DataFrame, column: str, *, falls: bool) -> float:
    """Return the mean over views of Kendall's tau with the knob, with three values or more."""
    taus = []
    for _, rows in records.groupby("view"):
        known = rows[np.isfinite(rows[column].astype(float))]
        if len(known) >= 3:
            taus.append(kendalltau(known[column], known["knob"]).statistic * (-1 if falls else 1))
    return float(np.mean(taus)) if taus else float("nan")


def scanned(*, scans: int = 99, views: int = 12, preset: str = "msl-navcam") -> list[Table]:
    """Compare the sphericity of single views of scanned rocks with that of the whole mesh."""
    rows: list[tuple[Cell, ...]] = []
    errors: dict[tuple[str, str], list[NDArray[np.float64]]] = {}
    for path in SCANS[:scans]:
        table = {
            "seed": SEED,
            "renderer": "embree",
            "rocks": {"count": 1, "family": "scan", "series": "random", "scans": [str(path)]},
            "camera": {"preset": preset, "distance_m": 4.5, "supersample": 1},
            "views": {"count": views},
            "noise": {"kind": "stereo"},
        }
        found: dict[tuple[str, str], list[float]] = {}
        for view in made_views(convert_spec(table, where="scans")):
            box = view.rocks[0]["maximum_projection_sphericity"]
            for key, frame in measured_both(view).items():
                found.setdefault(key, []).extend(frame["sphericity_3d"].astype(float))
        whole = whole_sphericity(scan(str(path), diameter_m=0.4).mesh)
        cells = [f"{np.nanmean(v):.3f} ± {np.nanstd(v):.3f}" for v in found.values()]
        rows.append((path.stem, box, whole, *cells))
        for key, values in found.items():
            errors.setdefault(key, []).append(np.abs(np.array(values) - whole))
    means = [f"{np.nanmean(np.concatenate(one)):.3f}" for one in errors.values()]
    rows.append(("mean absolute error to the whole mesh", None, None, *means))
    heads = [Column(f"{kind}, {method}") for kind, method in errors]
    columns = (Column("rock"), Column("box", "", ".3f"), Column("whole mesh", "", ".3f"))
    return [Table((*columns, *heads), rows)]


def whole_sphericity(mesh: Mesh, *, samples: int = 6000) -> float:
    """Return the sphericity of the ellipsoid through points spread over the surface by area."""
    rng = np.random.default_rng(0)
    corners = mesh.vertices_m[mesh.faces]
    double = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(double, axis=1)
    chosen = rng.choice(len(area), samples, p=area / area.sum())
    points = np.einsum("nk,nkj->nj", rng.dirichlet(np.ones(3), samples), corners[chosen])
    fit = fit_ellipsoid(points + np.array([0.0, 0.0, 10.0]))
    return float("nan") if fit is None else sphericity_3d(fit.ellipsoid.half_axes_m)


SOLIDS_CASE = Case(
    name="solids",
    what="3-D measures against truth, rocks of 0.28 to 0.42 m with their true masks",
    run=against_truth,
    smallest={"runs": (("form", 6.0),), "scenes": 1, "preset": "imp"},
)

SCANS_CASE = Case(
    name="scans",
    what="3-D sphericity of the scanned rocks in examples/rocks, single views against the mesh",
    run=scanned,
    smallest={"scans": 1, "views": 1, "preset": "imp"},
)
