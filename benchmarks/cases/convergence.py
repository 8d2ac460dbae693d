"""Convergence of the numerical truths under halved steps, and of the smallest box."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from case import Case, Cell, Column, Table
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from synth.geometry.min_volume_box import nearby_box
from synth.rocks import RockModel, quarry
from synth.rocks.ellipsoid import ellipsoid
from synth.rocks.outlines import OutlineTruth, SuperellipsoidForm, mesh_form, plane_across
from synth.rocks.outlines.silhouette import BEARINGS
from synth.rocks.outlines.smooth import DIRECTIONS
from synth.rocks.realistic import Realism, realistic
from synth.rocks.relief import with_relief
from synth.rocks.scan import scan
from synth.rocks.superellipsoid import NODES, integrals, superellipsoid
from synth.spec.rocks import RocksSpec

SCANS = sorted((Path(__file__).parents[2] / "examples" / "rocks").glob("*.ply"))
HALF_AXES_M = np.array([0.2, 0.16, 0.12])
EXPONENTS = ((2.5, 4.0), (6.0, 3.0), (10.0, 10.0))
RAYS = np.array([[0.35, -0.55, 0.76], [0.9, 0.1, 0.4], [-0.2, 0.9, 0.4]])
PLANES = [plane_across(ray) for ray in RAYS]
REALISM = Realism(
    cuts=12,
    chips=24,
    slab=0.3,
    abrasion=0.2,
    waviness=0.035,
    relief_rms=0.005,
    relief_degrees=(15, 45),
    subdivisions=6,
)
TRUTHS = ("V", "S", "inertia", "box", "A", "L", "axis ratio", "roundness 2-D")
Maker = Callable[[int, int], RockModel]  # from a seed and how often the facets' edges are halved
Moves = dict[str, float]


def rough(base: Callable[[int], RockModel]) -> Maker:
    """Return the maker of rocks under the default relief."""
    usual = RocksSpec()
    return lambda seed, halvings: with_relief(
        base(seed),
        relief_rms=float(np.mean(usual.relief_rms)),
        degrees=usual.relief_degrees,
        rng=np.random.default_rng(seed),
        halvings=halvings,
    )


def _realistic(seed: int, halvings: int) -> RockModel:
    finer = replace(REALISM, subdivisions=REALISM.subdivisions + halvings)
    return realistic(HALF_AXES_M, finer, rng=np.random.default_rng(seed))


MAKERS: dict[str, Maker] = {
    "perturbed": rough(lambda _: ellipsoid(HALF_AXES_M)),
    "superellipsoid with relief": rough(
        lambda _: superellipsoid(HALF_AXES_M, exponents=(3.0, 4.0))
    ),
    "rounded polyhedron with relief": rough(
        lambda seed: quarry(RocksSpec(count=1), rng=np.random.default_rng(seed))[0]
    ),
    "scan with relief": rough(lambda seed: scan(str(SCANS[seed % len(SCANS)]), diameter_m=0.4)),
    "realistic": _realistic,
}


def halved_steps(*, rocks: int = 3, families: int = 5, turns: int = 120) -> list[Table]:
    """Halve each step in turn, then compare smoothed outlines and the box with finer searches."""
    makers = dict(list(MAKERS.items())[:families])
    rows = {"superellipsoid: nodes and tangents": worst([quadrature(e) for e in EXPONENTS[:rocks]])}
    for name, maker in makers.items():
        rows[f"{name}: bearings"] = worst([bearings(maker(seed, 0)) for seed in range(rocks)])
        rows[f"{name}: facets' edges"] = worst([facets(maker, seed) for seed in range(rocks)])
    cells: list[list[Cell]] = [
        [name, *(row.get(truth) for truth in TRUTHS)] for name, row in rows.items()
    ]
    columns = (Column("halved"), *(Column(truth, "", ".0e") for truth in TRUTHS))
    return [
        Table(columns, cells, name="steps"),
        boxes(makers, 2 * rocks - 1, turns),
    ]


def facets(maker: Maker, seed: int) -> Moves:
    """Return the relative moves of a rock's truths under halved edges of its facets."""
    one, two = maker(seed, 0), maker(seed, 1)
    # The box may turn with its rock: rays are of the first, an even mesh's first vertices of both.
    few = min(len(one.mesh.vertices_m), len(two.mesh.vertices_m))
    left, _, right = np.linalg.svd(two.mesh.vertices_m[:few].T @ one.mesh.vertices_m[:few])
    turn = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
    forms = [rock.form or mesh_form(rock.mesh) for rock in (one, two)]
    pairs = [
        outline_moves(forms[0].outline(plane_across(ray)), forms[1].outline(plane_across(seen)))
        for ray, seen in zip(RAYS, RAYS @ turn.T, strict=True)
    ]
    return worst(pairs) | {
        "V": _off(one.truth.volume_m3, two.truth.volume_m3),
        "inertia": _off(one.truth.half_axes_inertia_m, two.truth.half_axes_inertia_m),
        "box": _off(one.truth.half_axes_box_m, two.truth.half_axes_box_m),
    }


def bearings(rock: RockModel) -> Moves:
    """Return the relative moves of silhouettes under halved steps."""
    form = mesh_form(rock.mesh)
    return worst(
        [
            outline_moves(form.silhouette(one), form.silhouette(one, bearings=2 * BEARINGS))
            for one in PLANES
        ]
    )


def quadrature(exponents: tuple[float, float]) -> Moves:
    """Return the relative moves of a superellipsoid under halved steps."""
    one, two = (integrals(HALF_AXES_M, exponents, nodes=nodes) for nodes in (NODES, 2 * NODES))
    form = SuperellipsoidForm(HALF_AXES_M, exponents)
    pairs = [
        outline_moves(form.outline(one), form.outline(one, directions=2 * DIRECTIONS))
        for one in PLANES
    ]
    return worst(pairs) | {
        "V": _off(one[0], two[0]),
        "S": _off(one[1], two[1]),
        "inertia": _off(np.sqrt(one[2]), np.sqrt(two[2])),
    }


def outline_moves(one: OutlineTruth, two: OutlineTruth) -> Moves:
    """Return the relative moves of an outline's truths."""
    return {
        "A": _off(one.area_m2, two.area_m2),
        "L": _off(one.perimeter_m, two.perimeter_m),
        "axis ratio": _off(one.axis_ratio, two.axis_ratio),
        "roundness 2-D": _off(one.roundness, two.roundness),
    }


def boxes(makers: dict[str, Maker], rocks: int, turns: int) -> Table:
    """Return the excess volume of the truth's box over the best of searches from random turns."""
    starts = Rotation.random(turns, random_state=0).as_matrix()
    rows = []
    for name, maker in makers.items():
        excess = []
        for seed in range(100, 100 + rocks):
            rock = maker(seed, 0)
            points_m = rock.mesh.vertices_m[ConvexHull(rock.mesh.vertices_m).vertices]
            sides = [nearby_box(points_m @ start.T).half_sides_m for start in starts]
            best = min(float(np.prod(side)) for side in sides)
            excess.append(float(np.prod(rock.truth.half_axes_box_m)) / best - 1.0)
        rows.append((name, rocks, turns, max(excess)))
    columns = (
        Column("family"),
        Column("rocks", "", "d"),
        Column("searches", "", "d"),
        Column("excess volume", "", ".0e"),
    )
    return Table(columns, rows, name="boxes")


def worst(found: list[Moves]) -> Moves:
    """Return the largest of each."""
    return {name: max(one[name] for one in found) for name in found[0]}


def _off(one: object, two: object) -> float:
    return float(np.abs(np.asarray(one) / np.asarray(two) - 1.0).max())


TRUTH_CONVERGENCE_CASE = Case(
    name="truth_convergence",
    what="largest relative change of numerical truths when a step is halved",
    run=halved_steps,
    smallest={"rocks": 1, "families": 1, "turns": 2},
)
