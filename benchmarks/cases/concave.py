"""Truth of rocks that are not convex, under halved edges and beside a picture."""

import numpy as np
import trimesh
from case import Case, Column, Table
from cases.convergence import PLANES, outline_moves, worst
from parallel_picture import pictured

from synth.rocks import RockModel, quarry
from synth.spec.rocks import RocksSpec

FAMILIES = ("dented", "lumpy", "broken", "vesicular", "slab")
TRUTHS = ("V", "S", "inertia", "calipers", "A", "L", "axis ratio", "roundness 2-D")
SUBDIVISIONS = 6  # of the datasets' meshes
SEED = 10_000


def concave_truth(
    *, families: int = len(FAMILIES), rocks: int = 1, pixels: int = 800
) -> list[Table]:
    """Largest relative change of each truth when edges are halved to the datasets', and errors."""
    rows = []
    for family in FAMILIES[:families]:
        moves, errors = [], []
        for seed in range(SEED, SEED + rocks):
            coarse, fine = (_made(family, seed, SUBDIVISIONS - halving) for halving in (1, 0))
            moves.append(_moves(coarse, fine))
            errors.append(_errors(fine, pixels))
        found = worst(moves) | worst(errors)
        rows.append((family, *(found.get(truth) for truth in (*TRUTHS, *errors[0]))))
    columns = (
        Column("family"),
        *(Column(truth, "", ".0e") for truth in (*TRUTHS, "V, trimesh", "A, picture")),
    )
    return [Table(columns, rows)]


def _made(family: str, seed: int, subdivisions: int) -> RockModel:
    spec = RocksSpec(count=1, family=family, options={"subdivisions": subdivisions})
    return quarry(spec, rng=np.random.default_rng(seed))[0]


def _moves(coarse: RockModel, fine: RockModel) -> dict[str, float]:
    """Relative moves of a rock's truths; views are of the finer body's frame."""
    few = len(coarse.mesh.vertices_m)
    left, _, right = np.linalg.svd(fine.mesh.vertices_m[:few].T @ coarse.mesh.vertices_m)
    turn = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
    forms = [rock.outlines() for rock in (coarse, fine)]
    seen = [
        outline_moves(forms[0].outline(plane @ turn), forms[1].outline(plane)) for plane in PLANES
    ]
    solid = {
        "V": (coarse.truth.volume_m3, fine.truth.volume_m3),
        "inertia": (coarse.truth.half_axes_inertia_m, fine.truth.half_axes_inertia_m),
        "calipers": (forms[0].caliper_half_axes_m()[:2], forms[1].caliper_half_axes_m()[:2]),
    }
    if fine.truth.area_m2 is not None:
        solid["S"] = (coarse.truth.area_m2, fine.truth.area_m2)
    return worst(seen) | {
        name: float(np.abs(np.asarray(one) / np.asarray(two) - 1.0).max())
        for name, (one, two) in solid.items()
    }


def _errors(rock: RockModel, pixels: int) -> dict[str, float]:
    solid = trimesh.Trimesh(rock.mesh.vertices_m, rock.mesh.faces, process=False)
    area_m2 = pictured(rock.mesh, PLANES[0], pixels)[0]
    return {
        "V, trimesh": abs(solid.volume / rock.truth.volume_m3 - 1.0),
        "A, picture": abs(area_m2 / rock.outlines().outline(PLANES[0]).area_m2 - 1.0),
    }


CONCAVE_TRUTH_CASE = Case(
    name="concave_truth",
    what="truth of rocks that are not convex under halved edges, and beside a picture",
    run=concave_truth,
    smallest={"families": 1, "rocks": 1, "pixels": 100},
)
