"""Placement of rocks: apart from one another, and either in every view or all over a disc."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats
from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.camera.projection import border_rays
from synth.errors import SpecError
from synth.geometry.mesh import Mesh
from synth.spec.population import PopulationSpec

_DARTS = 2000  # places tried at once for a rock
_STARTS = 40  # fresh starts before the ground counts as full
_TRIAL_STARTS = 3
_CLEARLY = 0.7  # of a crowd: when a sample says that fewer fit, it is not worth trying
_THROWS, _FEW = 60, 50  # of a population: rounds of fewer darts, without a fresh start
_FRAME_MARGIN = 1.05  # a rock's sphere, with this much to spare, lies inside every view


@dataclass(frozen=True, eq=False)
class PlacementArea:
    """Placement area: ground on which rocks lie inside every view."""

    reach_m: float  # from the scene's centre
    spacing: float  # least distance of two places over the sum of the rocks' radii
    frustums: Sequence[Floats]  # (4, 4) each, see `frustum`
    foot_m: Callable[[Floats], Floats]  # heights of the ground, or of its plane, at places (n, 2)


def scatter(meshes: Sequence[Mesh], yard: PlacementArea, *, rng: np.random.Generator) -> Floats:
    """Places (n, 2) on the ground for rocks that stand on the vertical through the origin.

    The distance between two places is at least spacing × the sum of the rocks' radii about the
    vertical; a sphere round each rock is inside every frustum. Places are drawn evenly over the
    ground; when one rock finds none, all start afresh.

    Raises:
        SpecError: the ground is full.
    """
    places_m = _thrown(_sizes_m(meshes), yard, rng, starts=_STARTS)
    if len(places_m) < len(meshes):
        raise _full(len(places_m), yard, len(meshes))
    return places_m


def refuse_crowd(
    count: int, sample: Sequence[Mesh], yard: PlacementArea, *, rng: np.random.Generator
) -> None:
    """Raise if by far not so many rocks fit, before all are made: a few stand for the rest.

    Raises:
        SpecError: rocks of the sample's sizes fill the ground with less than 0.7 of the count.
    """
    places_m = _thrown(np.resize(_sizes_m(sample), (count, 2)), yard, rng, starts=_TRIAL_STARTS)
    if len(places_m) < _CLEARLY * count:
        raise _full(len(places_m), yard, count)


def _thrown(
    sizes_m: Floats, yard: PlacementArea, rng: np.random.Generator, *, starts: int
) -> Floats:
    """Places for rocks of the sizes (n, 2) of `_sizes_m`; where not all fit, the most."""
    radii_m, middles_m = sizes_m.T
    spheres_m = _FRAME_MARGIN * np.hypot(radii_m, middles_m)
    most_m = np.empty((0, 2))
    for _ in range(starts):
        places_m = np.empty((0, 2))
        for radius_m, middle_m, sphere_m in zip(radii_m, middles_m, spheres_m, strict=True):
            darts_m = _over_disc_m(_DARTS, yard.reach_m, rng)
            middles = middle_m + yard.foot_m(darts_m)
            free = _inside(darts_m, middles, sphere_m, yard.frustums)
            gaps_m = np.linalg.norm(darts_m[:, None] - places_m, axis=2)
            least_m = yard.spacing * (radius_m + radii_m[: len(places_m)])
            free &= (gaps_m >= least_m).all(axis=1)
            if not free.any():
                break
            places_m = np.vstack([places_m, darts_m[np.argmax(free)]])
        if len(places_m) > len(most_m):
            most_m = places_m
        if len(most_m) == len(sizes_m):
            break
    return most_m


def _full(most: int, yard: PlacementArea, count: int) -> SpecError:
    return SpecError(
        f"rocks.count: the ground in view is full: expected at most {most} rocks at "
        f"spacing {yard.spacing:g}, found {count}"
    )


def strew(
    meshes: Sequence[Mesh],
    spec: PopulationSpec,
    *,
    keep_out_m: Floats,
    rng: np.random.Generator,
) -> Floats:
    """Places (n, 2) on the disc for rocks, none over another in plan.

    The rocks come largest first. `clustered` draws a centre for each cluster, evenly, and then
    each rock's place round one of them (Thomas 1949); what leaves the disc is drawn anew.
    `keep_out_m` (m, 3) are points x, y and a radius that stay free, the camera's stations.

    Raises:
        SpecError: the ground is full; the message tells how many rocks fit.
    """
    radii_m = reaches_m(meshes)
    clusters = max(1, round(len(meshes) / spec.cluster_rocks))
    centres_m = _over_disc_m(clusters, spec.radius_m, rng)
    places_m = np.empty((0, 2))
    for number, radius_m in enumerate(radii_m):
        taken_m = np.concatenate([places_m, keep_out_m[:, :2]])
        least_m = radius_m + np.concatenate([radii_m[:number], keep_out_m[:, 2]])
        for _ in range(_THROWS):
            darts_m = _over_disc_m(_FEW, spec.radius_m, rng)
            if spec.layout == "clustered":
                chosen = centres_m[rng.integers(clusters, size=_FEW)]
                darts_m = chosen + spec.cluster_radius_m * rng.standard_normal((_FEW, 2))
            free = np.hypot(*darts_m.T) <= spec.radius_m
            free &= (np.linalg.norm(darts_m[:, None] - taken_m, axis=2) >= least_m).all(axis=1)
            if free.any():
                places_m = np.vstack([places_m, darts_m[np.argmax(free)]])
                break
        else:
            raise SpecError(
                f"population.k: the ground is full: {number} rocks fit on a disc of "
                f"{spec.radius_m:g} m ({spec.layout}), found {len(meshes)}"
            )
    return places_m


def _sizes_m(meshes: Sequence[Mesh]) -> Floats:
    """Rocks' radii about the vertical and half their heights, (n, 2)."""
    middles_m = [mesh.vertices_m[:, 2].max() / 2.0 for mesh in meshes]
    return np.column_stack([reaches_m(meshes), middles_m])


def reaches_m(meshes: Sequence[Mesh]) -> Floats:
    """Rocks' radii about the vertical through the origin, (n,)."""
    return np.array([np.linalg.norm(mesh.vertices_m[:, :2], axis=1).max() for mesh in meshes])


def frustum(camera: RenderCamera, pose: Pose) -> Floats:
    """Four sides of a view as planes (4, 4): n·x + d is the depth inside, in metres.

    Where a lens bends the frame's sides, each plane stands where its side comes farthest in.
    """
    left, top, right, bottom = border_rays(camera)
    normals = np.array(
        [
            [1.0, 0.0, -left[:, 0].max()],
            [-1.0, 0.0, right[:, 0].min()],
            [0.0, 1.0, -top[:, 1].max()],
            [0.0, -1.0, bottom[:, 1].min()],
        ]
    )
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return np.column_stack([normals @ pose.world_to_camera, normals @ pose.translation_m])


def _over_disc_m(count: int, reach_m: float, rng: np.random.Generator) -> Floats:
    """Points (n, 2) evenly over a disc."""
    radius_m = reach_m * np.sqrt(rng.uniform(size=count))
    azimuth_rad = rng.uniform(0.0, 2.0 * np.pi, size=count)
    return np.column_stack([radius_m * np.cos(azimuth_rad), radius_m * np.sin(azimuth_rad)])


def _inside(
    places_m: Floats, middles_m: Floats, sphere_m: float, frustums: Sequence[Floats]
) -> NDArray[np.bool_]:
    """Mask of places at which spheres at the given heights are inside all frustums."""
    centres = np.column_stack([places_m, middles_m, np.ones(len(places_m))])
    inside = np.ones(len(places_m), dtype=bool)
    for planes in frustums:
        inside &= (centres @ planes.T >= sphere_m).all(axis=1)
    return inside
