"""Form of rocks by the parts of the whole body: what each adds, on scans and families held out."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from case import Case, Cell, Column, Table
from numpy.typing import NDArray
from scipy.stats import kendalltau
from views import made_views

from rockshape.body import box_half_axes_m, completed, visible_surface
from rockshape.camera.free_space import seen_past
from rockshape.ellipsoid import Ellipsoid
from rockshape.measures.sphericity_3d import sphericity_3d
from rockshape.method import ROBUST
from rockshape.pipeline import measure
from rockshape.rock.view import RockView
from synth.spec import convert_spec

ROCKS = Path(__file__).parents[2] / "examples" / "rocks"
SEED = 10_000
DRAWS = 1000
FORM = {"b_over_a": [0.5, 1.0], "c_over_b": [0.4, 1.0]}
SETS: dict[str, dict[str, Any]] = {
    "scans": {"family": "scan", "scans": sorted(str(path) for path in ROCKS.glob("*.ply"))},
    "rounded-polyhedron": {"family": "rounded-polyhedron", **FORM},
    "dented": {"family": "dented", **FORM},
    "realistic": {"family": "realistic", **FORM},
}

Axes = NDArray[np.float64]


def _nothing_seen(points_m: NDArray[np.float64]) -> NDArray[np.bool_]:
    return np.zeros(len(points_m), dtype=np.bool_)


def _visible_box(view: RockView, body: Ellipsoid) -> Axes | None:
    """Smallest box of the visible points and their feet on the ground."""
    del body
    plane = view.ground.plane if view.ground is not None else None
    if plane is None:
        return None
    points = view.points_m
    feet = points - plane.height_m(points)[:, None] * plane.normal
    return box_half_axes_m(np.concatenate([points, feet]))


def _completed(view: RockView, body: Ellipsoid, *, grounded: bool, carved: bool) -> Axes | None:
    if view.grid_m is None or view.ground is None or view.camera is None:
        return None
    outside = partial(
        seen_past, mask=view.mask, corner=view.corner, camera=view.camera, grid_m=view.grid_m
    )
    whole = completed(
        visible_surface(body, view.grid_m, view.point_fit.attached, view.noise),
        body,
        plane=view.ground.plane if grounded else None,
        seen_past=outside if carved else _nothing_seen,
    )
    return box_half_axes_m(whole)


def _ellipsoid(view: RockView, body: Ellipsoid) -> Axes:
    del view
    return body.half_axes_m


ESTIMATORS: dict[str, Callable[[RockView, Ellipsoid], Axes | None]] = {
    "constrained ellipsoid": _ellipsoid,
    "box of visible points and feet": _visible_box,
    "visible and reflected": partial(_completed, grounded=False, carved=True),
    "and foot, nothing carved": partial(_completed, grounded=True, carved=False),
    "and carved: the whole body": partial(_completed, grounded=True, carved=True),
}


def _views(rocks: dict[str, Any], stations: int, preset: str) -> Iterator[tuple[str, Any, Axes]]:
    """Range, view of a rock and its true half-axes, of every rock in plain sight."""
    table = {
        "seed": SEED,
        "renderer": "embree",
        "rocks": {"count": 5, "series": "random", "spacing": 1.6, **rocks},
        "ground": {"resting": "stable"},
        "camera": {"preset": preset, "distance_m": 4.5, "supersample": 1},
        "views": {"count": stations},
        "noise": {"kind": "stereo"},
    }
    for view in made_views(convert_spec(table, where="forms")):
        plain = {
            number + 1: np.array(view.rocks[number]["half_axes_box_m"])
            for number, seen in view.seen.items()
            if not seen["truncated"] and seen["visible_fraction"] >= 0.8
        }
        for kind, observation in (("exact", view.exact), ("stereo", view.observation)):
            kept: list[RockView] = []

            def keep(rock: RockView, kept: list[RockView] = kept) -> float:
                kept.append(rock)
                return 0.0

            listener = replace(ROBUST.measures[0], evaluate=keep)
            found = measure(
                observation, method=replace(ROBUST, measures=(listener,)), labels=view.labels
            )
            for rock, seen in zip(found, kept, strict=True):
                if rock.number in plain and seen.held_ellipsoid is not None:
                    yield kind, seen, plain[rock.number]


def forms(
    *, sets: tuple[str, ...] = tuple(SETS), views: int = 4, preset: str = "msl-navcam"
) -> list[Table]:
    """Error of each estimator's sphericity and axes against the smallest box, by set and range."""
    rows: list[tuple[Cell, ...]] = []
    for name in sets:
        found: dict[tuple[str, str], list[tuple[Axes, Axes]]] = {}
        for kind, view, true in _views(SETS[name], views, preset):
            body = view.held_ellipsoid
            for label, estimate in ESTIMATORS.items():
                axes = estimate(view, body)
                if axes is not None:
                    found.setdefault((kind, label), []).append((axes, true))
        for (kind, label), pairs in sorted(found.items(), key=lambda item: item[0][0]):
            rows.append((name, kind, label, len(pairs), *_scores(pairs)))
    columns = (
        Column("rocks"),
        Column("range"),
        Column("estimator"),
        Column("rock views", "", "d"),
        Column("sphericity MAE"),
        Column("bias", "", "+.3f"),
        Column("τ", "", ".2f"),
        Column("a/b/c error", "%"),
        Column("one constant, MAE", "", ".3f"),
    )
    return [Table(columns, rows)]


def _scores(pairs: list[tuple[Axes, Axes]]) -> list[Cell]:
    """Cells of one row: MAE with a bootstrap interval over rock views, bias, tau, axes."""
    axes = np.array([one for one, _ in pairs])
    true = np.array([other for _, other in pairs])
    value = np.array([sphericity_3d(one) for one in axes])
    truth = np.array([sphericity_3d(one) for one in true])
    error = value - truth
    drawn = np.random.default_rng(0).integers(len(error), size=(DRAWS, len(error)))
    low, high = np.quantile(np.abs(error)[drawn].mean(axis=1), [0.025, 0.975])
    slips = " / ".join(f"{100 * slip:.0f}" for slip in np.abs(axes / true - 1).mean(axis=0))
    return [
        f"{np.abs(error).mean():.3f} ({low:.3f}…{high:.3f})",
        error.mean(),
        kendalltau(value, truth).statistic,
        slips,
        np.abs(truth - np.median(truth)).mean(),
    ]


FORMS_CASE = Case(
    name="forms",
    what="form of scans and families held out, by each part of the whole body",
    run=forms,
    smallest={"sets": ("rounded-polyhedron",), "views": 1, "preset": "msl-navcam"},
)
