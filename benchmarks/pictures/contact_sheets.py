"""Contact sheets of the rock families, each at five settings of its main knob."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from cases.dent_forms import DENTS
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from PIL import Image
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from synth.rocks import RockModel, quarry
from synth.rocks.ellipsoid import ellipsoid
from synth.rocks.polyhedron import tangent_cuts
from synth.rocks.realistic import Realism, realistic
from synth.rocks.relief import with_relief
from synth.rocks.rounded import UnsettledError, rounded_box, rounded_polyhedron
from synth.rocks.scan import scan
from synth.rocks.superellipsoid import superellipsoid
from synth.spec.rocks import RocksSpec

SIZE_PX, FIELD_M, FINE = 280, 0.6, 2
HALF_AXES_M = np.array([0.2, 0.165, 0.125])
SCANS = ("apollo_sample16", "apollo_sample2")
CAMERA_RAD, SUN = np.deg2rad(28.0), np.array([-0.62, -0.35, 0.62])
SKY, ALBEDO, GROUND_ALBEDO = 0.22, 0.5, 0.42


def picture(rock: RockModel, *, yaw_rad: float) -> np.ndarray:
    """Return a rock on the ground under the sun, (SIZE_PX, SIZE_PX), shadows by rays."""
    planes = ConvexHull(rock.mesh.vertices_m).equations
    lowest = planes[np.argmax(planes[:, 3])]  # the facet nearest to the centroid goes down
    down, _ = Rotation.align_vectors([[0.0, 0.0, -1.0]], [lowest[:3]])
    rotation = (Rotation.from_euler("z", yaw_rad) * down).as_matrix()
    height_m = -lowest[3]
    mesh = rock.mesh.moved(rotation, np.array([0.0, 0.0, height_m]))
    half = 3.0
    corners_m = np.array([[-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0]])
    start = len(mesh.vertices_m)
    vertices_m = np.concatenate([mesh.vertices_m, corners_m])
    faces = np.concatenate([mesh.faces, start + np.array([[0, 1, 2], [0, 2, 3]])])
    normals = np.concatenate([mesh.normals, np.tile([0.0, 0.0, 1.0], (4, 1))])
    scene = EmbreeScene()
    TriangleMesh(scene, vertices_m[faces].astype(np.float32))
    count = SIZE_PX * FINE
    grid = (np.arange(count) + 0.5) / count - 0.5
    right, up = np.meshgrid(FIELD_M * grid, -FIELD_M * grid)
    view = np.array([0.0, np.cos(CAMERA_RAD), -np.sin(CAMERA_RAD)])
    above = np.array([0.0, np.sin(CAMERA_RAD), np.cos(CAMERA_RAD)])
    origins = right.ravel()[:, None] * [1.0, 0.0, 0.0] + up.ravel()[:, None] * above
    origins += np.array([0.0, 0.0, 0.11]) - 2.0 * view
    rays = np.broadcast_to(view, origins.shape)
    found = scene.run(origins.astype(np.float32), rays.astype(np.float32), output=1)
    share = np.column_stack([1.0 - found["u"] - found["v"], found["u"], found["v"]])
    face = faces[found["primID"]]
    points_m = np.einsum("nk,nkj->nj", share, vertices_m[face])
    normal = np.einsum("nk,nkj->nj", share, normals[face])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    sun = SUN / np.linalg.norm(SUN)
    lifted = (points_m + 2e-4 * normal + 4e-3 * sun).astype(np.float32)
    towards = np.broadcast_to(sun, lifted.shape).astype(np.float32)
    lit = scene.run(lifted, towards, query="OCCLUDED") < 0
    albedo = np.where(found["primID"] < len(mesh.faces), ALBEDO, GROUND_ALBEDO)
    light = SKY * (0.65 + 0.35 * normal[:, 2]) + (1 - SKY) * lit * np.maximum(normal @ sun, 0.0)
    value = np.clip(1.6 * albedo * light, 0.0, 1.0).reshape(SIZE_PX, FINE, SIZE_PX, FINE)
    return np.asarray(value.mean(axis=(1, 3)))


def polyhedron(half_axes_m: np.ndarray, *, rounding: float, seed: int = 3) -> RockModel:
    """Return a rounded polyhedron, of the first body after a seed that holds its axes."""
    for attempt in range(50):
        body = tangent_cuts(HALF_AXES_M, cuts=13, rng=np.random.default_rng(seed + attempt))
        try:
            return rounded_polyhedron(body, half_axes_m, rounding=rounding)
        except UnsettledError:
            continue
    raise UnsettledError


def broken(seed: int, **changes: float) -> RockModel:
    """Return a realistic rock with some knobs changed."""
    usual = Realism(
        cuts=12,
        chips=24,
        slab=0.3,
        abrasion=0.12,
        waviness=0.035,
        relief_rms=0.005,
        relief_degrees=(15, 45),
        subdivisions=6,
    )
    return realistic(HALF_AXES_M, replace(usual, **changes), rng=np.random.default_rng(seed))


def rough(base: RockModel, rms: float, degrees: tuple[int, int] = (5, 25)) -> RockModel:
    """Return a rock under one relief of a given height."""
    return with_relief(base, relief_rms=rms, degrees=degrees, rng=np.random.default_rng(8))


def concave(
    family: str, seed: int, abrasion: float | None = None, dents: tuple[int, int] | None = None
) -> RockModel:
    """Return a rock of a family that is not convex, worn and with dents where they are given."""
    spec = RocksSpec(
        count=1,
        family=family,
        diameter_m=(0.4, 0.4),
        b_over_a=(0.8, 0.9),
        c_over_b=(0.7, 0.85),
        **({} if abrasion is None else {"abrasion": (abrasion, abrasion)}),
        **({} if dents is None else {"options": {"dents": dents}}),
    )
    return quarry(spec, rng=np.random.default_rng(seed))[0]


def real(folder: Path) -> np.ndarray:
    """Return two scans, two pieces of a photograph of gravel and one of Mars, in a row."""
    tiles = [picture(scan(path, diameter_m=0.38), yaw_rad=0.7) for path in scans(folder)]
    gravel = np.array(Image.open(folder / "grains" / "1_P1060330_1.jpg").convert("L"))
    mars = np.array(Image.open(folder / "mars" / "i944014r.png").convert("L"))
    for photo, (top, left, size) in (
        (gravel, (160, 0, 220)),
        (gravel, (250, 210, 200)),
        (mars, (0, 50, 150)),
    ):
        tile = Image.fromarray(photo[top : top + size, left : left + size])
        tiles.append((np.array(tile.resize((SIZE_PX, SIZE_PX))) / 255.0) ** 2.2)
    return np.hstack(tiles)


def scans(examples: Path) -> list[str]:
    """Return the meshes of SCANS."""
    return [str(examples / "rocks" / f"{name}.ply") for name in SCANS]


def sheets(scans: list[str]) -> dict[str, list[Callable[[], RockModel]]]:
    """Return the makers of each sheet's five rocks."""
    flat = [HALF_AXES_M * [1.0, k, k**2] for k in (0.7, 0.8, 0.9, 1.0, 1.1)]
    return {
        "rounded-polyhedron": [
            lambda k=k: polyhedron(HALF_AXES_M, rounding=k) for k in (0.02, 0.08, 0.2, 0.4, 0.8)
        ],
        "rounded-box": [
            lambda k=k: rounded_box(HALF_AXES_M, rounding=k) for k in (0.02, 0.1, 0.3, 0.8, 2.0)
        ],
        "ellipsoid": [lambda axes=axes: ellipsoid(axes) for axes in flat],
        "superellipsoid": [
            lambda p=p: superellipsoid(HALF_AXES_M, exponents=(p, p))
            for p in (2.0, 2.7, 3.6, 5.0, 10.0)
        ],
        "perturbed": [
            lambda rms=rms: rough(ellipsoid(HALF_AXES_M), rms)
            for rms in (0.005, 0.01, 0.02, 0.03, 0.045)
        ],
        "relief-on-polyhedron": [
            lambda rms=rms: rough(polyhedron(HALF_AXES_M, rounding=0.1), rms)
            for rms in (0.0, 0.005, 0.01, 0.02, 0.03)
        ],
        "sphericity": [lambda axes=axes: polyhedron(axes, rounding=0.15) for axes in flat],
        "realistic-abrasion": [
            lambda k=k: broken(21, abrasion=k) for k in (0.0, 0.25, 0.5, 0.75, 1.0)
        ],
        "realistic-slab": [lambda k=k: broken(33, slab=k) for k in (0.0, 0.25, 0.5, 0.75, 1.0)],
        "realistic-chips": [lambda k=k: broken(45, chips=k) for k in (0, 10, 25, 60, 120)],
        "realistic": [lambda seed=seed: broken(seed) for seed in range(50, 55)],
        **{
            family: [lambda family=family, seed=seed: concave(family, seed) for seed in range(5)]
            for family in ("dented", "lumpy", "broken", "vesicular", "slab")
        },
        "with-dents": [
            *(lambda name=name: concave(name, 1, dents=DENTS[name]) for name in DENTS),
            lambda: scan(scans[0], diameter_m=0.38),
        ],
        "worn": [
            lambda amount=amount: concave("broken", 1, amount)
            for amount in (0.0, 0.1, 0.25, 0.5, 1.0)
        ],
        "scan": [
            lambda path=path, rms=rms: (
                scan(path, diameter_m=0.38)
                if rms == 0.0
                else rough(scan(path, diameter_m=0.38), rms, (10, 50))
            )
            for path, rms in zip(
                [*scans, *scans, scans[0]], (0.0, 0.0, 0.008, 0.008, 0.012), strict=True
            )
        ],
    }


def draw(folder: Path) -> None:
    """Write rocks-NAME.jpg of every sheet."""
    examples = Path(__file__).parents[2] / "examples"
    _save(real(examples), folder / "rocks-real.jpg")
    for name, makers in sheets(scans(examples)).items():
        row = np.hstack([picture(make(), yaw_rad=0.7) for make in makers])
        _save(row, folder / f"rocks-{name}.jpg")


def _save(row: np.ndarray, path: Path) -> None:
    pixels = np.rint(255.0 * row ** (1.0 / 2.2)).astype(np.uint8)
    Image.fromarray(pixels).save(path, quality=88)
