"""Print, for every family, how near meshes and pictures come to its truth."""

import argparse
from pathlib import Path

import cv2
import numpy as np
import trimesh
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from scipy.optimize import linprog
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
from synth.rocks.outlines.record import axis_ratio
from synth.rocks.polyhedron import from_half_spaces
from synth.rocks.rounding import rounded_mesh
from synth.rocks.sphere import SUBDIVISIONS
from synth.rocks.superellipsoid import SUBDIVISIONS as FINER_SUBDIVISIONS
from synth.rocks.superellipsoid import superellipsoid_mesh
from synth.rocks.truth import half_axes_of_covariance_m
from synth.spec.rocks import RocksSpec

FAMILIES = ("rounded-polyhedron", "rounded-box", "ellipsoid", "superellipsoid")
ROUGH = ("perturbed", "realistic", "scan")  # whose mesh is the body
SCANS = sorted((Path(__file__).parent.parent / "examples" / "rocks").glob("*.ply"))
ACROSS = plane_across(np.array([0.35, -0.55, 0.76]))
HALVINGS = 2  # of the datasets' facets' edges in the refined mesh
EDGE_SPLIT = 16  # the picture's edge pixels are split into so many squared


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


def solid_errors(rock: RockModel, mesh: Mesh) -> dict[str, float]:
    """Return the relative errors of a mesh's volume, area and inertia's half-axes."""
    truth = rock.truth
    half_axes_m = half_axes_of_covariance_m(covariance_m2(mesh))
    return {
        "V": abs(volume_m3(mesh) / truth.volume_m3 - 1.0),
        "S": abs(area_m2(mesh) / truth.area_m2 - 1.0),
        "inertia": float(np.abs(half_axes_m / truth.half_axes_inertia_m - 1.0).max()),
    }


def outline_errors(rock: RockModel, mesh: Mesh, count: int) -> dict[str, float]:
    """Return the relative errors of the outline, from the silhouette and from a picture."""
    exact = rock.form.outline(ACROSS)
    flat = mesh_form(mesh).outline(ACROSS)
    area, perimeter, ratio, disc_m = pictured(mesh, count)
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


def rough_errors(rock: RockModel, count: int) -> dict[str, float]:
    """Return how far trimesh's solid and a picture are from the truth of a body that its mesh is.

    trimesh gives the moments of inertia I about the axes; the covariance is (tr I/2 − I)/V.
    """
    solid = trimesh.Trimesh(rock.mesh.vertices_m, rock.mesh.faces, process=False)
    inertia = np.asarray(solid.moment_inertia)
    covariance_m2 = (np.trace(inertia) / 2.0 * np.eye(3) - inertia) / solid.volume
    half_axes_m = np.sqrt(5.0 * np.linalg.eigvalsh(covariance_m2)[::-1])
    flat = mesh_form(rock.mesh).outline(ACROSS)
    area, _, ratio, _ = pictured(rock.mesh, count)
    return {
        "V": abs(solid.volume / rock.truth.volume_m3 - 1.0),
        "inertia": float(np.abs(half_axes_m / rock.truth.half_axes_inertia_m - 1.0).max()),
        "A picture": abs(area / flat.area_m2 - 1.0),
        "axis ratio picture": abs(ratio / flat.axis_ratio - 1.0),
    }


def pictured(mesh: Mesh, count: int) -> tuple[float, float, float, float]:
    """Return area, its hull's perimeter, axis ratio and its hull's inner radius of a picture.

    Parallel rays through the centres of count × count pixels; those at the edge are split. The
    perimeter is π times the mean width over all directions (Cauchy).
    """
    scene = EmbreeScene(robust=True)
    TriangleMesh(scene, mesh.vertices_m[mesh.faces].astype(np.float32))
    half_m = 1.05 * float(np.linalg.norm(mesh.vertices_m, axis=1).max())
    pixel_m = 2.0 * half_m / count
    grid = (np.arange(count) + 0.5) * pixel_m - half_m
    mask = np.stack([_hit(scene, np.column_stack([grid, np.full(count, y)])) for y in grid])
    core = np.ones((3, 3), np.uint8)
    inner = cv2.erode(mask.astype(np.uint8), core) > 0
    edge = (cv2.dilate(mask.astype(np.uint8), core) > 0) & ~inner
    places = np.argwhere(inner)
    whole_m = np.column_stack([grid[places[:, 1]], grid[places[:, 0]]])
    offsets = ((np.arange(EDGE_SPLIT) + 0.5) / EDGE_SPLIT - 0.5) * pixel_m
    shifts = np.stack(np.meshgrid(offsets, offsets), axis=-1).reshape(-1, 2)
    rows, columns = np.nonzero(edge)
    tried_m = np.column_stack([grid[columns], grid[rows]])[:, None] + shifts
    parts_m = np.concatenate([part[_hit(scene, part)] for part in tried_m.transpose(1, 0, 2)])
    points_m = np.concatenate([whole_m, parts_m])
    weights = np.repeat([1.0, 1.0 / EDGE_SPLIT**2], [len(whole_m), len(parts_m)])
    hull = ConvexHull(parts_m)
    turn_rad = np.pi * np.arange(3600) / 3600
    along_m = parts_m[hull.vertices] @ np.stack([np.cos(turn_rad), np.sin(turn_rad)])
    inside = linprog(
        [0.0, 0.0, -1.0],
        A_ub=np.column_stack([hull.equations[:, :2], np.ones(len(hull.equations))]),
        b_ub=-hull.equations[:, 2],
        bounds=[(None, None)] * 2 + [(0, None)],
    )
    return (
        float(weights.sum()) * pixel_m**2,
        float(np.pi * np.ptp(along_m, axis=0).mean()),
        axis_ratio(np.cov(points_m.T, aweights=weights)),
        float(inside.x[2]),
    )


def _hit(scene: EmbreeScene, points_m: np.ndarray) -> np.ndarray:
    """Tell through which points of the plane, (n, 2), the ray meets the body."""
    ray = np.cross(ACROSS[0], ACROSS[1])
    origins = (points_m @ ACROSS - 2.0 * ray).astype(np.float32)
    rays = np.broadcast_to(ray, origins.shape).astype(np.float32)
    return np.asarray(scene.run(origins, rays) >= 0)


def table(rows: dict[str, list[dict[str, float]]]) -> None:
    """Print the largest of each family's errors in Markdown, and of those on the finest mesh."""
    columns = list(dict.fromkeys(name for found in rows.values() for name in found[0]))
    print("| family | " + " | ".join(columns) + " | largest, finest mesh |")
    print("| --- |" + " --- |" * (len(columns) + 1))
    for family, found in rows.items():
        worst = {name: max(one[name] for one in found) for name in found[0]}
        cells = [f"{worst[name]:.1e}" if name in worst else "–" for name in columns]
        finest = [v for name, v in worst.items() if "mesh" not in name and "edges/2" not in name]
        print(f"| {family} | " + " | ".join(cells) + f" | {max(finest):.1e} |")


def perspective() -> None:
    """Print what perspective makes of an outline."""
    rock = quarry(RocksSpec(count=1), rng=np.random.default_rng(7))[0]
    form = mesh_form(rock.mesh)
    flat = form.outline(ACROSS)
    print("| distance over a | area | perimeter | axis ratio |\n| --- | --- | --- | --- |")
    for times in (8, 12, 25, 50):
        distance_m = times * float(rock.truth.half_axes_box_m[0])
        seen = form.silhouette(ACROSS, camera_m=distance_m)
        print(
            f"| {times} | {seen.area_m2 / flat.area_m2:.4f} "
            f"| {seen.perimeter_m / flat.perimeter_m:.4f} "
            f"| {seen.axis_ratio / flat.axis_ratio:.4f} |"
        )


def main() -> None:
    """Print the tables in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rocks", type=int, default=3, help="rocks of each family")
    parser.add_argument("--pixels", type=int, default=2000, help="across the picture")
    arguments = parser.parse_args()
    solids: dict[str, list[dict[str, float]]] = {}
    outlines: dict[str, list[dict[str, float]]] = {}
    for family in FAMILIES:
        spec = RocksSpec(count=arguments.rocks, family=family, series="random")
        rocks = quarry(spec, rng=np.random.default_rng(7))
        solids[family], outlines[family] = [], []
        for rock in rocks:
            found: dict[str, float] = {}
            for halvings in range(HALVINGS + 1):
                mesh = refined(rock, halvings)
                name = f"edges/{2**halvings}" if halvings else "datasets' mesh"
                errors = solid_errors(rock, mesh)
                found |= {f"{key}, {name}": value for key, value in errors.items()}
            solids[family].append(found)
            outlines[family].append(outline_errors(rock, mesh, arguments.pixels))
    print("Solids:\n")
    table(solids)
    print(f"\nOutlines, on the mesh with edges/{2**HALVINGS}:\n")
    table(outlines)
    print("\nBodies known by their meshes, against trimesh and the picture:\n")
    rough = {}
    for family in ROUGH:
        spec = RocksSpec(
            count=arguments.rocks, family=family, series="random", scans=tuple(map(str, SCANS))
        )
        rocks = quarry(spec, rng=np.random.default_rng(7))
        rough[family] = [rough_errors(rock, arguments.pixels) for rock in rocks]
    table(rough)
    print("\nA polyhedron's outline in perspective, over the parallel one:\n")
    perspective()


if __name__ == "__main__":
    main()
