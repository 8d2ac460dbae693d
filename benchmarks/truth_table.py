"""Print, for every family, its truth beside what its mesh and a fine rendering measure."""

import argparse
from pathlib import Path

import cv2
import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

from synth.mesh import area_m2, covariance_m2, volume_m3
from synth.outlines import Outline, mesh_form, plane_across
from synth.outlines.record import axis_ratio
from synth.rocks import FAMILIES, Rock, quarry
from synth.spec.rocks import RocksSpec
from synth.truth import half_axes_of_covariance_m

RAY = np.array([0.35, -0.55, 0.76])


def rendered(rock: Rock, count: int) -> tuple[float, float, float, float]:
    """Return area, perimeter (of the hull), axis ratio and inscribed radius of a fine picture.

    The perimeter is π times the mean width over all directions (Cauchy).
    """
    across = plane_across(RAY)
    scene = EmbreeScene(robust=True)
    TriangleMesh(scene, rock.mesh.vertices_m[rock.mesh.faces].astype(np.float32))
    half_m = 1.05 * float(np.linalg.norm(rock.mesh.vertices_m, axis=1).max())
    pixel_m = 2.0 * half_m / count
    grid = (np.arange(count) + 0.5) * pixel_m - half_m
    ray = np.cross(across[0], across[1])
    mask = np.zeros((count, count), dtype=np.uint8)
    for row, height in enumerate(grid):
        origins = grid[:, None] * across[0] + height * across[1] - 3.0 * half_m * ray
        rays = np.broadcast_to(ray, origins.shape).astype(np.float32)
        mask[row] = scene.run(origins.astype(np.float32), rays) >= 0
    points_m = np.argwhere(mask) * pixel_m
    turn_rad = np.pi * np.arange(360) / 360
    hull_m = points_m[cv2.convexHull(np.argwhere(mask), returnPoints=False)[:, 0]]
    along_m = hull_m @ np.stack([np.cos(turn_rad), np.sin(turn_rad)])
    widths_m = np.ptp(along_m, axis=0)
    disc_m = float(cv2.distanceTransform(mask, cv2.DIST_L2, cv2.DIST_MASK_PRECISE).max()) * pixel_m
    return (
        len(points_m) * pixel_m**2,
        float(np.pi * (widths_m.mean() + pixel_m * 4.0 / np.pi / 2.0)),
        axis_ratio(np.cov(points_m.T)),
        disc_m - 0.5 * pixel_m,
    )


def errors(rock: Rock, count: int) -> dict[str, float]:
    """Return the relative errors of what was measured."""
    truth, mesh = rock.truth, rock.mesh
    form = mesh_form(mesh)
    flat = form.outline(plane_across(RAY))
    exact: Outline = flat if rock.form is None else rock.form.outline(plane_across(RAY))
    area, perimeter, ratio, disc_m = rendered(rock, count)
    found = {
        "V mesh": volume_m3(mesh) / truth.volume_m3,
        "inertia mesh": float(
            (half_axes_of_covariance_m(covariance_m2(mesh)) / truth.half_axes_inertia_m).min()
        ),
        "A mesh": flat.area_m2 / exact.area_m2,
        "L mesh": flat.perimeter_m / exact.perimeter_m,
        "ratio mesh": flat.axis_ratio / exact.axis_ratio,
        "A picture": area / exact.area_m2,
        "ratio picture": ratio / exact.axis_ratio,
    }
    if truth.area_m2 is not None:
        found["S mesh"] = area_m2(mesh) / truth.area_m2
    if rock.form is not None:
        found["L picture"] = perimeter / exact.perimeter_m
    if truth.radius_m is not None and exact.roundness is not None:
        found["roundness picture"] = truth.radius_m / disc_m / exact.roundness
    halved = form.silhouette(plane_across(RAY), bearings=2048)
    found["L, half the bearings"] = halved.perimeter_m / flat.perimeter_m
    return {name: abs(value - 1.0) for name, value in found.items()}


def main() -> None:
    """Print the table in Markdown, and what perspective does to an outline."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rocks", type=int, default=3, help="rocks of each family")
    parser.add_argument("--pixels", type=int, default=2000, help="across the picture")
    arguments = parser.parse_args()
    folder = Path(__file__).parent.parent / "examples" / "rocks"
    scans = tuple(str(path) for path in sorted(folder.glob("*.ply")))
    columns = ["V mesh", "S mesh", "inertia mesh", "A mesh", "L mesh", "ratio mesh"]
    columns += ["A picture", "L picture", "ratio picture", "roundness picture"]
    columns += ["L, half the bearings"]
    print("| family | " + " | ".join(columns) + " | largest |")
    print("| --- |" + " --- |" * (len(columns) + 1))
    for family in FAMILIES:
        spec = RocksSpec(count=arguments.rocks, family=family, series="random", scans=scans)
        rows = [
            errors(rock, arguments.pixels) for rock in quarry(spec, rng=np.random.default_rng(7))
        ]
        worst = {name: max(row.get(name, 0.0) for row in rows) for name in rows[0]}
        cells = [f"{worst[name]:.1e}" if name in worst else "–" for name in columns]
        print(f"| {family} | " + " | ".join(cells) + f" | {max(worst.values()):.1e} |")
    rock = quarry(RocksSpec(count=1), rng=np.random.default_rng(7))[0]
    flat, form = mesh_form(rock.mesh).outline(plane_across(RAY)), mesh_form(rock.mesh)
    print("\nThe same outline in perspective, over the parallel one:\n")
    print("| distance over a | area | perimeter | axis ratio |\n| --- | --- | --- | --- |")
    for times in (8, 12, 25, 50):
        distance_m = times * float(rock.truth.half_axes_box_m[0])
        seen = form.silhouette(plane_across(RAY), camera_m=distance_m)
        print(
            f"| {times} | {seen.area_m2 / flat.area_m2:.4f} "
            f"| {seen.perimeter_m / flat.perimeter_m:.4f} "
            f"| {seen.axis_ratio / flat.axis_ratio:.4f} |"
        )


if __name__ == "__main__":
    main()
