"""Print how far numerical truths move when the step that they were computed with is halved."""

import argparse
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation
from scipy.stats import spearmanr

from synth.geometry.min_volume_box import nearby_box
from synth.rocks import RockModel, quarry
from synth.rocks.ellipsoid import ellipsoid
from synth.rocks.outlines import Form, OutlineTruth, SuperellipsoidForm, mesh_form, plane_across
from synth.rocks.outlines.silhouette import BEARINGS
from synth.rocks.outlines.smooth import DIRECTIONS
from synth.rocks.realistic import Realism, realistic
from synth.rocks.relief import with_relief
from synth.rocks.scan import scan
from synth.rocks.superellipsoid import NODES, integrals, superellipsoid
from synth.spec.rocks import RocksSpec

HALF_AXES_M = np.array([0.2, 0.16, 0.12])
RAYS = np.array([[0.35, -0.55, 0.76], [0.9, 0.1, 0.4], [-0.2, 0.9, 0.4]])
TURNS = 120  # from which boxes are sought for comparison
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
Maker = Callable[[int, int], RockModel]  # from a seed and how often the facets' edges are halved


def rough(base: Callable[[int], RockModel]) -> Maker:
    """Return the maker of rocks with the default relief."""
    usual = RocksSpec()
    rms = float(np.mean(usual.relief_rms))
    return lambda seed, halvings: with_relief(
        base(seed),
        relief_rms=rms,
        degrees=usual.relief_degrees,
        rng=np.random.default_rng(seed),
        halvings=halvings,
    )


def makers() -> dict[str, Maker]:
    """Return how each family whose mesh is the body is made at both steps."""
    folder = Path(__file__).parent.parent / "examples" / "rocks"
    scans = [str(path) for path in sorted(folder.glob("*.ply"))]
    return {
        "perturbed": rough(lambda _: ellipsoid(HALF_AXES_M)),
        "superellipsoid with relief": rough(
            lambda _: superellipsoid(HALF_AXES_M, exponents=(3.0, 4.0))
        ),
        "rounded polyhedron with relief": rough(
            lambda seed: quarry(RocksSpec(count=1), rng=np.random.default_rng(seed))[0]
        ),
        "scan with relief": rough(lambda seed: scan(scans[seed % len(scans)], diameter_m=0.4)),
        "realistic": lambda seed, halvings: realistic(
            HALF_AXES_M,
            replace(REALISM, subdivisions=REALISM.subdivisions + halvings),
            rng=np.random.default_rng(seed),
        ),
    }


def solid_moves(one: RockModel, two: RockModel) -> dict[str, float]:
    """Return how far the solid's truths move, relatively."""
    return {
        "V": abs(one.truth.volume_m3 / two.truth.volume_m3 - 1.0),
        "inertia": _largest(one.truth.half_axes_inertia_m, two.truth.half_axes_inertia_m),
        "box": _largest(one.truth.half_axes_box_m, two.truth.half_axes_box_m),
    }


def outline_moves(one: OutlineTruth, two: OutlineTruth) -> dict[str, float]:
    """Return how far an outline's truths move, relatively."""
    return {
        "A": abs(one.area_m2 / two.area_m2 - 1.0),
        "L": abs(one.perimeter_m / two.perimeter_m - 1.0),
        "axis ratio": abs(one.axis_ratio / two.axis_ratio - 1.0),
        "roundness 2-D": abs(one.roundness / two.roundness - 1.0),
    }


def _largest(one: np.ndarray, two: np.ndarray) -> float:
    return float(np.abs(one / two - 1.0).max())


def facets(maker: Maker, seed: int) -> dict[str, float]:
    """Return the moves of a rock and its outlines under halved edges."""
    one, two = maker(seed, 0), maker(seed, 1)
    # The box may turn with its rock: the same ray in both is that of the first.
    turn = _turn(one, two)
    pairs = [
        outline_moves(_form(one).outline(plane_across(ray)), _form(two).outline(plane_across(seen)))
        for ray, seen in zip(RAYS, RAYS @ turn.T, strict=True)
    ]
    return solid_moves(one, two) | _worst(pairs)


def _turn(one: RockModel, two: RockModel) -> np.ndarray:
    """Return the rotation from one rock's frame to the other's, of the same body."""
    few = min(len(one.mesh.vertices_m), len(two.mesh.vertices_m))
    # An even mesh's first vertices are those of the coarser one.
    first, second = one.mesh.vertices_m[:few], two.mesh.vertices_m[:few]
    left, _, right = np.linalg.svd(second.T @ first)
    return np.asarray(left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right)


def bearings(rock: RockModel) -> dict[str, float]:
    """Return the moves of silhouettes under halved steps."""
    form = mesh_form(rock.mesh)
    return _worst(
        [
            outline_moves(
                form.silhouette(plane_across(ray)),
                form.silhouette(plane_across(ray), bearings=2 * BEARINGS),
            )
            for ray in RAYS
        ]
    )


def quadrature(exponents: tuple[float, float]) -> dict[str, float]:
    """Return the moves of a superellipsoid under halved steps."""
    one, two = (integrals(HALF_AXES_M, exponents, nodes=nodes) for nodes in (NODES, 2 * NODES))
    form = SuperellipsoidForm(HALF_AXES_M, exponents)
    pairs = [
        outline_moves(
            form.outline(plane_across(ray)),
            form.outline(plane_across(ray), directions=2 * DIRECTIONS),
        )
        for ray in RAYS
    ]
    return {
        "V": abs(one[0] / two[0] - 1.0),
        "inertia": _largest(np.sqrt(one[2]), np.sqrt(two[2])),
        "S": abs(one[1] / two[1] - 1.0),
    } | _worst(pairs)


def _form(rock: RockModel) -> Form:
    return rock.form or mesh_form(rock.mesh)


def _worst(found: list[dict[str, float]]) -> dict[str, float]:
    return {name: max(one[name] for one in found) for name in found[0]}


def scales(count: int) -> None:
    """Print what smoothing and relief make of an exact roundness, graded polyhedra of scenes."""
    found = []
    for seed in range(count):
        for rock in quarry(RocksSpec(count=5), rng=np.random.default_rng(seed)):
            own = np.random.default_rng(seed)
            worn = with_relief(rock, relief_rms=0.01, degrees=(15, 40), rng=own)
            forms = (rock.form, mesh_form(rock.mesh), mesh_form(worn.mesh))
            found += [[form.outline(plane_across(ray)).roundness for form in forms] for ray in RAYS]
    exact, smooth, bumpy = np.transpose(found)
    print("\n| exact | outlines | smoothed | smoothed, with relief |\n| --- | --- | --- | --- |")
    for low, high in pairwise((0.0, 0.1, 0.2, 0.3, 0.4, 1.0)):
        chosen = (exact >= low) & (exact < high)
        means = [f"{values[chosen].mean():.2f}" for values in (exact, smooth, bumpy)]
        print(f"| {means[0]} | {chosen.sum()} | {means[1]} | {means[2]} |")
    ranks = [float(spearmanr(exact, values)[0]) for values in (smooth, bumpy)]
    print(f"\nRank correlation with the exact: {ranks[0]:.2f}; with relief {ranks[1]:.2f}")


def boxes(count: int) -> None:
    """Print by how much a search from many random turns finds boxes smaller than the truth's."""
    turns = Rotation.random(TURNS, random_state=0).as_matrix()
    print(f"\n| boxes of | rocks | volume above that of the best of {TURNS} searches |")
    print("| --- | --- | --- |")
    for name, maker in makers().items():
        excess = []
        for seed in range(100, 100 + count):
            rock = maker(seed, 0)
            points_m = rock.mesh.vertices_m[ConvexHull(rock.mesh.vertices_m).vertices]
            found = min(
                float(np.prod(nearby_box(points_m @ turn.T).half_sides_m)) for turn in turns
            )
            excess.append(float(np.prod(rock.truth.half_axes_box_m)) / found - 1.0)
        print(f"| {name} | {count} | {max(excess):.0e} |")


def main() -> None:
    """Print the tables in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rocks", type=int, default=3, help="rocks of each kind")
    count = parser.parse_args().rocks
    seeds = range(count)
    rows = {}
    exponents = [(2.5, 4.0), (6.0, 3.0), (10.0, 10.0)]
    rows["superellipsoid: nodes and tangents"] = _worst([quadrature(one) for one in exponents])
    for name, maker in makers().items():
        rows[f"{name}: facets' edges"] = _worst([facets(maker, seed) for seed in seeds])
        rows[f"{name}: bearings"] = _worst([bearings(maker(seed, 0)) for seed in seeds])
    columns = ("V", "S", "inertia", "box", "A", "L", "axis ratio", "roundness 2-D")
    print("| halved | " + " | ".join(columns) + " |\n| --- |" + " --- |" * len(columns))
    for name, row in rows.items():
        cells = [f"{row[column]:.0e}" if column in row else "–" for column in columns]
        print(f"| {name} | " + " | ".join(cells) + " |")
    scales(2 * count)
    boxes(2 * count)


if __name__ == "__main__":
    main()
