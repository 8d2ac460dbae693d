"""Truth of made rocks against meshes, pictures and perspective."""

from pathlib import Path

import numpy as np
import trimesh
from case import Case, Cell, Column, Table
from parallel_picture import pictured
from scipy.spatial import ConvexHull

from synth.geometry.mesh import Mesh, area_m2, covariance_m2, volume_m3
from synth.rocks import RockModel, quarry
from synth.rocks.ellipsoid import ellipsoid_mesh
from synth.rocks.outlines import (
    EllipsoidForm,
    RoundedHull,
    SuperellipsoidForm,
    mesh_form,
    plane_across,
)
from synth.rocks.polyhedron import from_half_spaces
from synth.rocks.rounding import rounded_mesh
from synth.rocks.sphere import SUBDIVISIONS
from synth.rocks.superellipsoid import SUBDIVISIONS as FINER_SUBDIVISIONS
from synth.rocks.superellipsoid import superellipsoid_mesh
from synth.rocks.truth import half_axes_of_covariance_m
from synth.spec.rocks import RocksSpec

FAMILIES = ("rounded-polyhedron", "rounded-box", "ellipsoid", "superellipsoid")


ROUGH = ("perturbed", "realistic", "scan")  # whose mesh is the body


SCANS = sorted((Path(__file__).parents[2] / "examples" / "rocks").glob("*.ply"))


ACROSS = plane_across(np.array([0.35, -0.55, 0.76]))


Errors = dict[str, float]


def against_meshes(*, families: int = 4, rocks: int = 3, pixels: int = 3000) -> list[Table]:
    """Hold the truths to refined meshes, to trimesh's solids and to pictures by parallel rays."""
    solids: dict[str, list[Errors]] = {}
    outlines: dict[str, list[Errors]] = {}
    for family in FAMILIES[:families]:
        for rock in _made(family, rocks):
            meshes = {
                f"edges/{2**n}" if n else "datasets' mesh": refined(rock, n) for n in range(3)
            }
            found = {
                f"{key}, {name}": value
                for name, mesh in meshes.items()
                for key, value in solid_errors(rock, mesh).items()
            }
            solids.setdefault(family, []).append(found)
            finest = list(meshes.values())[-1]
            outlines.setdefault(family, []).append(outline_errors(rock, finest, pixels))
    rough = {
        family: [rough_errors(rock, pixels) for rock in _made(family, rocks)]
        for family in ROUGH[:families]
    }
    return [
        _worst(solids, "solids"),
        _worst(outlines, "outlines"),
        _worst(rough, "meshes"),
        perspective(),
    ]


def _made(family: str, count: int) -> list[RockModel]:
    scans = tuple(map(str, SCANS)) if family == "scan" else ()
    spec = RocksSpec(count=count, family=family, series="random", scans=scans)
    return list(quarry(spec, rng=np.random.default_rng(7)))


def _worst(rows: dict[str, list[Errors]], name: str) -> Table:
    """Return the largest of each family's errors."""
    heads = list(dict.fromkeys(key for found in rows.values() for key in found[0]))
    cells: list[list[Cell]] = [
        [family, *(max(one[head] for one in found) if head in found[0] else None for head in heads)]
        for family, found in rows.items()
    ]
    return Table((Column("family"), *(Column(head, "", ".1e") for head in heads)), cells, name)


def refined(rock: RockModel, halvings: int) -> Mesh:
    """Return the rock's surface with the edges of its facets halved so often."""
    form = rock.form
    if isinstance(form, EllipsoidForm):
        return ellipsoid_mesh(form.half_axes_m, subdivisions=SUBDIVISIONS + halvings)
    if isinstance(form, SuperellipsoidForm):
        return superellipsoid_mesh(
            form.half_axes_m, form.exponents, subdivisions=FINER_SUBDIVISIONS + halvings
        )
    if not isinstance(form, RoundedHull):
        raise TypeError(rock.family)
    planes = ConvexHull(form.vertices_m).equations
    sides = planes[np.unique(planes.round(8), axis=0, return_index=True)[1]]
    body = from_half_spaces(sides[:, :3], -sides[:, 3])
    return rounded_mesh(body, form.radius_m, split=2**halvings)


def solid_errors(rock: RockModel, mesh: Mesh) -> Errors:
    """Return the relative errors of a mesh's volume, area and inertia's half-axes."""
    truth, half_axes_m = rock.truth, half_axes_of_covariance_m(covariance_m2(mesh))
    return {
        "V": abs(volume_m3(mesh) / truth.volume_m3 - 1.0),
        "S": abs(area_m2(mesh) / truth.area_m2 - 1.0),
        "inertia": float(np.abs(half_axes_m / truth.half_axes_inertia_m - 1.0).max()),
    }


def outline_errors(rock: RockModel, mesh: Mesh, count: int) -> Errors:
    """Return the relative errors of the outline, from the silhouette and from a picture."""
    exact = rock.form.outline(ACROSS)
    flat = mesh_form(mesh).outline(ACROSS)
    area, perimeter, ratio, disc_m = pictured(mesh, ACROSS, count)
    found = {
        "A": flat.area_m2 / exact.area_m2,
        "L": flat.perimeter_m / exact.perimeter_m,
        "axis ratio": flat.axis_ratio / exact.axis_ratio,
        "A picture": area / exact.area_m2,
        "L picture": perimeter / exact.perimeter_m,
        "axis ratio picture": ratio / exact.axis_ratio,
    }
    if rock.truth.radius_m is not None:
        found["roundness picture"] = rock.truth.radius_m / disc_m / exact.roundness
    return {name: abs(value - 1.0) for name, value in found.items()}


def rough_errors(rock: RockModel, count: int) -> Errors:
    """Return how far trimesh's solid and a picture are from the truth of a body that its mesh is.

    trimesh gives the moments of inertia I about the axes; the covariance is (tr I/2 − I)/V.
    """
    solid = trimesh.Trimesh(rock.mesh.vertices_m, rock.mesh.faces, process=False)
    inertia = np.asarray(solid.moment_inertia)
    covariance = (np.trace(inertia) / 2.0 * np.eye(3) - inertia) / solid.volume
    half_axes_m = np.sqrt(5.0 * np.linalg.eigvalsh(covariance)[::-1])
    flat = mesh_form(rock.mesh).outline(ACROSS)
    area, _, ratio, _ = pictured(rock.mesh, ACROSS, count)
    return {
        "V, trimesh": abs(solid.volume / rock.truth.volume_m3 - 1.0),
        "inertia, trimesh": float(np.abs(half_axes_m / rock.truth.half_axes_inertia_m - 1.0).max()),
        "A picture": abs(area / flat.area_m2 - 1.0),
        "axis ratio picture": abs(ratio / flat.axis_ratio - 1.0),
    }


def perspective() -> Table:
    """Return the ratio of a polyhedron's perspective outline to the parallel one."""
    rock = quarry(RocksSpec(count=1), rng=np.random.default_rng(7))[0]
    form = mesh_form(rock.mesh)
    flat = form.outline(ACROSS)
    rows = []
    for times in (8, 12, 25, 50):
        seen = form.silhouette(ACROSS, camera_m=times * float(rock.truth.half_axes_box_m[0]))
        ratios = (
            seen.area_m2 / flat.area_m2,
            seen.perimeter_m / flat.perimeter_m,
            seen.axis_ratio / flat.axis_ratio,
        )
        rows.append((times, *ratios))
    heads = ("area", "perimeter", "axis ratio")
    columns = (Column("distance over a", "", "d"), *(Column(head, "", ".4f") for head in heads))
    return Table(columns, rows, name="perspective")


TRUTH_TABLE_CASE = Case(
    name="truth_table",
    what="largest relative error of each family's truth against meshes and pictures",
    run=against_meshes,
    smallest={"families": 1, "rocks": 1, "pixels": 100},
)
