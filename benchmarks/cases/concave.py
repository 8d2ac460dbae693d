"""Truth of rocks that are not convex, under halved edges and beside a picture."""

import numpy as np
import trimesh
from case import Case, Column, Table
from cases.convergence import PLANES, outline_moves, worst
from parallel_picture import pictured

from synth.geometry.mesh import area_m2, covariance_m2, volume_m3
from synth.geometry.min_volume_box import smallest_box
from synth.rocks import RockModel, quarry
from synth.rocks.outlines import mesh_form
from synth.rocks.truth import half_axes_of_covariance_m
from synth.spec.rocks import RocksSpec

FAMILIES = ("dented", "lumpy", "broken", "vesicular", "slab")
TRUTHS = ("V", "S", "inertia", "box", "calipers", "A", "L", "axis ratio", "roundness 2-D")
ERRORS = ("box, excess volume", "V, trimesh", "A, picture")
SUBDIVISIONS = 6  # of the datasets' meshes
SEED = 10_000


def concave_truth(
    *,
    families: int = len(FAMILIES),
    rocks: int = 2,
    subdivisions: int = SUBDIVISIONS,
    pixels: int = 800,
) -> list[Table]:
    """Largest relative change of each truth when the edges of written meshes are halved, errors."""
    rows = []
    for family in FAMILIES[:families]:
        moves, errors = [], []
        for seed in range(SEED, SEED + rocks):
            rock = _made(family, seed, subdivisions)
            moves.append(_moves(rock, subdivisions + 1))
            errors.append(_errors(rock, pixels))
        found = worst(moves) | worst(errors)
        rows.append((family, rocks, *map(found.get, (*TRUTHS, *ERRORS))))
    columns = (
        Column("family"),
        Column("rocks", "", "d"),
        *(Column(truth, "", ".0e") for truth in (*TRUTHS, *ERRORS)),
    )
    return [Table(columns, rows)]


def _made(family: str, seed: int, subdivisions: int) -> RockModel:
    spec = RocksSpec(count=1, family=family, options={"subdivisions": subdivisions})
    return quarry(spec, rng=np.random.default_rng(seed))[0]


def _moves(rock: RockModel, finer: int) -> dict[str, float]:
    """Relative moves of a rock's truths to those of a finer mesh of its surface."""
    assert rock.remesh is not None
    fine = rock.remesh(finer)
    forms = (mesh_form(rock.mesh), mesh_form(fine))
    seen = [outline_moves(*(form.outline(plane) for form in forms)) for plane in PLANES]
    solid = {
        "V": (rock.truth.volume_m3, volume_m3(fine)),
        "inertia": (
            rock.truth.half_axes_inertia_m,
            half_axes_of_covariance_m(covariance_m2(fine)),
        ),
        "box": (rock.truth.half_axes_box_m, np.ptp(fine.vertices_m, axis=0) / 2.0),
        "calipers": tuple(form.caliper_half_axes_m() for form in forms),
    }
    if rock.truth.area_m2 is not None:
        solid["S"] = (rock.truth.area_m2, area_m2(fine))
    return worst(seen) | {
        name: float(np.abs(np.asarray(one) / np.asarray(two) - 1.0).max())
        for name, (one, two) in solid.items()
    }


def _errors(rock: RockModel, pixels: int) -> dict[str, float]:
    solid = trimesh.Trimesh(rock.mesh.vertices_m, rock.mesh.faces, process=False)
    area_m2 = pictured(rock.mesh, PLANES[0], pixels)[0]
    least_m3 = float(np.prod(smallest_box(rock.mesh.vertices_m).half_sides_m))
    return {
        "box, excess volume": float(np.prod(rock.truth.half_axes_box_m)) / least_m3 - 1.0,
        "V, trimesh": abs(solid.volume / rock.truth.volume_m3 - 1.0),
        "A, picture": abs(area_m2 / rock.outlines().outline(PLANES[0]).area_m2 - 1.0),
    }


CONCAVE_TRUTH_CASE = Case(
    name="concave_truth",
    what="truth of rocks that are not convex under halved edges, and beside a picture",
    run=concave_truth,
    smallest={"families": 1, "rocks": 1, "subdivisions": 4, "pixels": 100},
)
