"""Scenes: rocks that lie on the ground plane z = 0, apart from one another and in every view."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from synth.camera import PRESETS, Camera, Pose, ring
from synth.errors import InputError
from synth.mesh import Mesh
from synth.rocks import Rock, quarry
from synth.spec import SceneSpec
from synth.spec.view import CameraSpec, ViewsSpec

Floats = NDArray[np.float64]

_DARTS = 2000  # places tried at once for a rock
_RESTARTS = 40  # fresh starts before the ground counts as full
_FRAME_MARGIN = 1.05  # a rock's sphere, with this much to spare, lies inside every view


@dataclass(frozen=True, eq=False)
class PlacedRock:
    """A rock and where it lies."""

    rock: Rock
    model_to_world: Floats  # (3, 3) rotation
    position_m: Floats  # (3,), the centroid in the world
    albedo: float
    mesh: Mesh  # in the world


@dataclass(frozen=True, eq=False)
class Scene:
    """Rocks on the ground, the camera and its stations."""

    rocks: tuple[PlacedRock, ...]
    camera: Camera
    poses: tuple[Pose, ...]


def build_scene(spec: SceneSpec, index: int) -> Scene:
    """Return scene `index` of a dataset, a function of its arguments alone.

    Raises:
        InputError: the rocks do not fit.
    """
    rng = np.random.default_rng([spec.seed, index])
    camera = PRESETS[spec.camera.preset].camera
    poses = stations(spec.camera, spec.views)
    settled = [
        settle(rock, yaw_rad=rng.uniform(0.0, 2.0 * np.pi)) for rock in quarry(spec.rocks, rng=rng)
    ]
    meshes = [
        rock.mesh.moved(rotation, np.array([0.0, 0.0, height_m]))
        for rock, rotation, height_m in settled
    ]
    places_m = scatter(
        meshes,
        reach_m=camera_distance_m(spec.camera),
        spacing=spec.rocks.spacing,
        frustums=[frustum(camera, pose) for pose in poses],
        rng=rng,
    )
    albedos = rng.uniform(*spec.rocks.albedo, size=len(meshes))
    rocks = tuple(
        PlacedRock(
            rock=rock,
            model_to_world=rotation,
            position_m=np.array([place[0], place[1], height_m]),
            albedo=float(albedo),
            mesh=mesh.moved(np.eye(3), np.array([place[0], place[1], 0.0])),
        )
        for (rock, rotation, height_m), mesh, place, albedo in zip(
            settled, meshes, places_m, albedos, strict=True
        )
    )
    return Scene(rocks=rocks, camera=camera, poses=tuple(poses))


def camera_distance_m(spec: CameraSpec) -> float:
    """Return the camera's distance from the scene's centre."""
    return PRESETS[spec.preset].distance_m if spec.distance_m is None else spec.distance_m


def stations(camera: CameraSpec, views: ViewsSpec) -> list[Pose]:
    """Return the poses of a scene's views."""
    return ring(
        count=views.count,
        distance_m=camera_distance_m(camera),
        elevation_rad=np.deg2rad(camera.elevation_deg),
        start_rad=np.deg2rad(views.start_deg),
    )


def settle(rock: Rock, *, yaw_rad: float) -> tuple[Rock, Floats, float]:
    """Return a rock, the rotation in which it lies stably, and its centroid's height.

    The facet of the convex hull nearest to the centroid goes down: the lowest place the centroid
    can take, so the body cannot roll. The yaw then turns it about the vertical.
    """
    planes = ConvexHull(rock.mesh.vertices_m).equations
    nearest = int(np.argmin(-planes[:, 3]))
    tilt = _shortest_turn(planes[nearest, :3], np.array([0.0, 0.0, -1.0]))
    cosine, sine = np.cos(yaw_rad), np.sin(yaw_rad)
    yaw = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    return rock, yaw @ tilt, float(-planes[nearest, 3])


def frustum(camera: Camera, pose: Pose) -> Floats:
    """Return the four sides of a view as planes (4, 4): n·x + d is the depth inside, in metres."""
    left, right = camera.cx + 0.5, camera.width - 0.5 - camera.cx
    top, bottom = camera.cy + 0.5, camera.height - 0.5 - camera.cy
    normals = np.array(
        [
            [camera.fx, 0.0, left],
            [-camera.fx, 0.0, right],
            [0.0, camera.fy, top],
            [0.0, -camera.fy, bottom],
        ]
    )
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return np.column_stack([normals @ pose.world_to_camera, normals @ pose.translation_m])


def scatter(
    meshes: Sequence[Mesh],
    *,
    reach_m: float,
    spacing: float,
    frustums: Sequence[Floats],
    rng: np.random.Generator,
) -> Floats:
    """Return places (n, 2) on the ground for rocks that stand on the vertical through the origin.

    The distance between two places is at least spacing × the sum of the rocks' radii about the
    vertical; a sphere round each rock is inside every frustum. Places are drawn evenly over the
    ground; when one rock finds none, all start afresh.

    Raises:
        InputError: the ground is full.
    """
    radii_m = np.array([np.linalg.norm(mesh.vertices_m[:, :2], axis=1).max() for mesh in meshes])
    middles_m = np.array([mesh.vertices_m[:, 2].max() / 2.0 for mesh in meshes])
    spheres_m = _FRAME_MARGIN * np.hypot(radii_m, middles_m)
    most = 0
    for _ in range(_RESTARTS):
        places_m = np.empty((0, 2))
        for radius_m, middle_m, sphere_m in zip(radii_m, middles_m, spheres_m, strict=True):
            darts_m = _darts_m(reach_m, rng)
            free = _inside(darts_m, middle_m, sphere_m, frustums)
            gaps_m = np.linalg.norm(darts_m[:, None] - places_m, axis=2)
            least_m = spacing * (radius_m + radii_m[: len(places_m)])
            free &= (gaps_m >= least_m).all(axis=1)
            if not free.any():
                break
            places_m = np.vstack([places_m, darts_m[np.argmax(free)]])
        if len(places_m) == len(meshes):
            return places_m
        most = max(most, len(places_m))
    raise InputError(
        f"rocks.count: the ground in view is full: expected at most {most} rocks at "
        f"spacing {spacing:g}, found {len(meshes)}"
    )


def _darts_m(reach_m: float, rng: np.random.Generator) -> Floats:
    """Return points (n, 2) evenly over a disc."""
    radius_m = reach_m * np.sqrt(rng.uniform(size=_DARTS))
    azimuth_rad = rng.uniform(0.0, 2.0 * np.pi, size=_DARTS)
    return np.column_stack([radius_m * np.cos(azimuth_rad), radius_m * np.sin(azimuth_rad)])


def _inside(
    places_m: Floats, middle_m: float, sphere_m: float, frustums: Sequence[Floats]
) -> NDArray[np.bool_]:
    """Tell which places keep a sphere at the given height inside all frustums."""
    centres = np.column_stack([places_m, np.full(len(places_m), middle_m), np.ones(len(places_m))])
    inside = np.ones(len(places_m), dtype=bool)
    for planes in frustums:
        inside &= (centres @ planes.T >= sphere_m).all(axis=1)
    return inside


def _shortest_turn(start: Floats, end: Floats) -> Floats:
    """Return the rotation (3, 3) by the least angle that takes one unit vector to another."""
    cosine = float(start @ end)
    if cosine < -1.0 + 1e-12:
        helper = np.eye(3)[np.argmin(np.abs(start))]
        axis = np.cross(start, helper)
        axis /= np.linalg.norm(axis)
        return np.asarray(2.0 * np.outer(axis, axis) - np.eye(3))
    x, y, z = np.cross(start, end)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + cross + cross @ cross / (1.0 + cosine))
