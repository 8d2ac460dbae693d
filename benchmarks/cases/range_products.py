"""Range sensors: error against the exact range, and meshes beside a product's statistics."""

from pathlib import Path

import cv2
import numpy as np
from case import Case, Column, Table
from numpy.typing import NDArray
from range_views import Measured, measured_views
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

Floats = NDArray[np.float64]

PRODUCT = Path(__file__).parents[2] / "examples" / "mars" / "i944014r_xyz.npz"
EYE_M = (0.06, 0.17, 1.35)  # of the product's camera in the lander's frame, resected from its grid
_SAME_FACET = 1e-5  # of the cosine between normals of neighbouring cells
_MIN_PX = 12  # of a facet that counts: cells across its edges have normals of their own
_STEP = 0.02  # of the range: a jump between neighbours that is an edge
_NEAR_PX = 5  # round an edge


def ranges(*, first: int = 10_000, scenes: int = 3) -> list[Table]:
    """Measure scenes of rocks by each sensor; compare meshes with the product."""
    made: dict[str, list[Measured]] = {}
    for seed in range(first, first + scenes):
        for one in measured_views(seed):
            made.setdefault(one.name, []).append(one)
    errors = [_errors(name, views) for name, views in made.items()]
    product = np.load(PRODUCT)["xyz"].astype(np.float64)
    meshes = [("product i944014r", [(product, np.array(EYE_M))])]
    meshes += [
        (name, [(one.points_m(), np.zeros(3)) for one in views])
        for name, views in made.items()
        if name.startswith("mesh") or name == "stereo"
    ]
    return [
        Table(
            (
                Column("sensor"),
                Column("holes", "%", ".1f"),
                Column("RMS error", "mm", ".1f"),
                Column("median error", "mm", ".1f"),
                Column("RMS near edges", "mm", ".1f"),
                Column("near edges, off by > 2 %", "%", ".1f"),
            ),
            errors,
            name="errors",
        ),
        Table(
            (
                Column("range"),
                Column("facets", "", ".0f"),
                Column("median facet", "px", ".0f"),
                Column("quartiles", "px"),
                Column("holes", "%", ".1f"),
                Column("median step of a pixel", "‰", ".2f"),
                Column("99 % step", "‰", ".1f"),
                Column("99.9 % step", "‰", ".1f"),
            ),
            [_mesh(name, grids) for name, grids in meshes],
            name="meshes",
        ),
    ]


def _errors(name: str, views: list[Measured]) -> tuple[str, float, float, float, float, float]:
    """Row of a sensor's errors of z-depth over all its views."""
    error = np.concatenate([(one.depth_m - one.exact_m).ravel() for one in views])
    exact = np.concatenate([one.exact_m.ravel() for one in views])
    edge = np.concatenate([_near_edges(one.exact_m).ravel() for one in views])
    known = np.isfinite(error)
    near = error[known & edge]
    return (
        name,
        100.0 * float(1.0 - known.mean()),
        1e3 * float(np.sqrt((error[known] ** 2).mean())),
        1e3 * float(np.median(np.abs(error[known]))),
        1e3 * float(np.sqrt((near**2).mean())),
        100.0 * float((np.abs(near) > _STEP * exact[known & edge]).mean()),
    )


def _near_edges(depth_m: Floats) -> NDArray[np.bool_]:
    side = 2 * _NEAR_PX + 1
    known = np.log(np.nan_to_num(depth_m, nan=1e3))
    box = np.ones((3, 3), np.uint8)
    jump = cv2.dilate(known, box) - cv2.erode(known, box) > _STEP
    return np.asarray(cv2.dilate(jump.astype(np.uint8), np.ones((side, side), np.uint8)) > 0)


def _mesh(
    name: str, grids: list[tuple[Floats, Floats]]
) -> tuple[str, float | None, float | None, str | None, float, float, float, float]:
    """Row of facets and of the relative steps of range from a pixel to the next, means of grids."""
    sizes = [facet_sizes(points_m) for points_m, _ in grids]
    pooled = np.concatenate(sizes)
    steps = np.concatenate([_steps(points_m - eye_m) for points_m, eye_m in grids])
    holes = np.mean([np.isnan(points_m[..., 2]).mean() for points_m, _ in grids])
    quartiles = np.percentile(pooled, [25, 50, 75]) if len(pooled) else None
    low, middle, high = (1e3 * float(part) for part in np.percentile(steps, [50, 99, 99.9]))
    return (
        name,
        len(pooled) / len(grids) if len(pooled) else None,
        None if quartiles is None else float(quartiles[1]),
        None if quartiles is None else f"{quartiles[0]:.0f} … {quartiles[2]:.0f}",
        100.0 * float(holes),
        low,
        middle,
        high,
    )


def facet_sizes(points_m: Floats) -> NDArray[np.int64]:
    """Pixels of each facet of at least 12: connected cells of one normal."""
    normals = np.cross(np.diff(points_m, axis=1)[:-1], np.diff(points_m, axis=0)[:, :-1])
    normals /= np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-30)
    rows, cols = normals.shape[:2]
    number = np.arange(rows * cols).reshape(rows, cols)
    alike = [
        (one, two, (normals[one] * normals[two]).sum(axis=-1) > 1.0 - _SAME_FACET)
        for one, two in (
            (np.s_[:, :-1], np.s_[:, 1:]),
            (np.s_[:-1], np.s_[1:]),
        )
    ]
    pairs = np.concatenate(
        [np.column_stack([number[one][same], number[two][same]]) for one, two, same in alike]
    )
    graph = coo_matrix((np.ones(len(pairs)), tuple(pairs.T)), shape=(rows * cols,) * 2)
    _, facet = connected_components(graph, directed=False)
    sizes = np.bincount(facet)
    return sizes[sizes >= _MIN_PX]


def _steps(rays_m: Floats) -> Floats:
    """Relative steps of range between neighbours, along rows and columns."""
    log = np.log(np.linalg.norm(rays_m, axis=-1))
    steps = np.concatenate([np.diff(log, axis=0).ravel(), np.diff(log, axis=1).ravel()])
    return np.abs(steps[np.isfinite(steps)])


RANGE_PRODUCTS_CASE = Case(
    name="range_products",
    what="range sensors on one kind of scene, and coarse meshes beside a Pathfinder product",
    run=ranges,
    smallest={"first": 1, "scenes": 1},
)
