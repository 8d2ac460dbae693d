"""Scene model: a ground, the rocks that lie on it, the camera and its stations."""

from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

import msgspec
import numpy as np

from synth.arrays import Floats
from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.camera.trajectories import camera_distance_m, camera_of, stations
from synth.rocks import RockModel, quarry
from synth.rocks.family import Make
from synth.rocks.sampling import made, planned
from synth.scene.finish import draw_finishes, draw_wetness
from synth.scene.ground import SceneGround, make_ground
from synth.scene.laying import PlacedRock, lay, stood, sunk
from synth.scene.placement import (
    PlacementArea,
    frustum,
    refuse_crowd,
    scatter,
    strew,
)
from synth.scene.population import draw_diameters_m
from synth.scene.thing_placement import place_things, reach_in_view_m
from synth.spec import SceneSpec, dataset_of, tints_of
from synth.spec.things import ThingsSpec
from synth.things.record import PlacedThing

# Children of the scene's seed.
_LYING, _GROUND, _POPULATION, _SHARED = 1, 2, 3, 12
_FINISH, _WETNESS, _THINGS, _WIND = 31, 33, 34, 35
_ROOM_M = 0.4  # kept free of a population's rocks round the foot of each station
_CROWD, _SAMPLE = 24, 12  # more rocks than the first are tried with the second before all are made


@dataclass(frozen=True, eq=False)
class SceneModel:
    """Scene model: rocks on the ground, the camera and its stations."""

    rocks: tuple[PlacedRock, ...]
    camera: RenderCamera
    poses: tuple[Pose, ...]
    ground: SceneGround
    wetness: float = 0.0  # 0 dry … 1 under a film of water
    things: tuple[PlacedThing, ...] = ()  # no rocks
    mast_shadow: bool = False  # the camera's own mast shades the ground


def build_scene(spec: SceneSpec, index: int, *, pool: Executor | None = None) -> SceneModel:
    """Scene `index` of a dataset, a function of its spec and number alone.

    The processes of a pool make the rocks while this one draws them. What can be switched on draws
    from generators of its own, so that it does not change the rest.

    Raises:
        SpecError: the rocks do not fit.
    """
    rng = np.random.default_rng([spec.seed, index])
    camera, poses = camera_of(spec.camera), stations(spec.camera, spec.views)
    counted = spec.population.kind == "count"
    reach_m = camera_distance_m(spec.camera) if counted else spec.population.radius_m
    ground = make_ground(spec.ground, radius_m=reach_m, rng=_child(spec, index, _GROUND))
    lying = _child(spec, index, _LYING)
    yard = PlacementArea(
        reach_m=reach_m,
        spacing=spec.rocks.spacing,
        frustums=[frustum(camera, pose) for pose in poses],
        foot_m=ground.foot_m,
    )
    if counted and spec.rocks.count > _CROWD:
        _refuse_crowd(spec, yard, ground, rng=np.random.default_rng([spec.seed, index]))
    rocks = _rocks(spec, index, rng=rng, pool=pool)
    falling = None if spec.ground.resting == "flattest" else lying
    standing = stood(rocks, ground, rng=rng, falling=falling, pool=pool)
    meshes = [one.mesh for one in standing]
    if counted:
        places_m = scatter(meshes, yard, rng=rng)
    else:
        places_m = strew(meshes, spec.population, keep_out_m=_feet_m(poses), rng=lying)
    albedos = rng.uniform(*spec.rocks.albedo, size=len(meshes))
    burials = lying.uniform(*spec.ground.burial, size=len(meshes))
    finishes = draw_finishes(tints_of(spec), len(meshes), rng=_child(spec, index, _FINISH))
    placed = tuple(
        lay(one, place, ground, burial=burial, albedo=float(albedo), finish=finish)
        for one, place, burial, albedo, finish in zip(
            standing, places_m, burials, albedos, finishes, strict=True
        )
    )
    drifted = ground.behind([one.mesh for one in placed], rng=_child(spec, index, _WIND))
    if drifted is not ground:
        ground, placed = drifted, tuple(sunk(one, drifted) for one in placed)
    wanted = ThingsSpec(kinds=()) if isinstance(spec.things, msgspec.UnsetType) else spec.things
    return SceneModel(
        rocks=placed,
        camera=camera,
        poses=tuple(poses),
        ground=ground,
        wetness=draw_wetness(tints_of(spec), rng=_child(spec, index, _WETNESS)),
        things=place_things(
            wanted,
            ground,
            [one.mesh for one in placed],
            reach_m=reach_in_view_m(camera, camera_distance_m(spec.camera)),
            rng=_child(spec, index, _THINGS),
        ),
        mast_shadow="mast-shadow" in wanted.kinds,
    )


def _child(spec: SceneSpec, index: int, key: int) -> np.random.Generator:
    return np.random.default_rng([spec.seed, index, key])


def _rocks(
    spec: SceneSpec, index: int, *, rng: np.random.Generator, pool: Executor | None
) -> list[RockModel]:
    """Scene's own rocks, or those that all scenes of the dataset share."""
    counted = spec.population.kind == "count"
    if dataset_of(spec).shared_rocks:
        shared = _child(spec, 0, _SHARED)
        return quarry(spec.rocks, rng=shared, pool=pool) if counted else _population(spec, 0, pool)
    return quarry(spec.rocks, rng=rng, pool=pool) if counted else _population(spec, index, pool)


def _population(spec: SceneSpec, index: int, pool: Executor | None) -> list[RockModel]:
    """Population's rocks, largest first."""
    rng = _child(spec, index, _POPULATION)
    diameters_m = draw_diameters_m(spec.population, rng=rng)
    return made(_planned(spec, diameters_m, rng), spec.rocks, len(diameters_m), pool=pool)


def _planned(spec: SceneSpec, diameters_m: Floats, rng: np.random.Generator) -> Iterator[Make]:
    """Rocks of diameters D, the mean of length and width, a + b, with their numbers drawn."""
    for diameter_m in diameters_m.tolist():
        ratio = rng.uniform(*spec.rocks.b_over_a)
        longest_m = 2.0 * diameter_m / (1.0 + ratio)
        one = msgspec.structs.replace(
            spec.rocks,
            count=1,
            series="random",
            diameter_m=(longest_m, longest_m),
            b_over_a=(ratio, ratio),
        )
        yield from planned(one, rng=rng)


def _feet_m(poses: Sequence[Pose]) -> Floats:
    """Places below the stations with the room to keep there, (n, 3)."""
    return np.array([[*pose.position_m()[:2], _ROOM_M] for pose in poses])


def _refuse_crowd(
    spec: SceneSpec, yard: PlacementArea, ground: SceneGround, *, rng: np.random.Generator
) -> None:
    """Raise SpecError if by far not all rocks fit: a few are made and laid over and over.

    With the scene's own seed they are of the scene's own forms.
    """
    sample = quarry(msgspec.structs.replace(spec.rocks, count=_SAMPLE), rng=rng)
    meshes = [one.mesh for one in stood(sample, ground, rng=rng, falling=None)]
    refuse_crowd(spec.rocks.count, meshes, yard, rng=rng)
