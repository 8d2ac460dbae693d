"""Scene model: a ground, the rocks that lie on it, the camera and its stations."""

from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field

import msgspec
import numpy as np

from synth.arrays import Floats
from synth.camera.camera import Pose, RenderCamera
from synth.camera.trajectories import camera_distance_m, camera_of, stations
from synth.geometry.mesh import Mesh
from synth.rocks import RockModel, quarry
from synth.rocks.family import Make
from synth.rocks.sampling import made, planned
from synth.scene.finish import Finish, draw_finishes, draw_wetness
from synth.scene.ground import SceneGround, make_ground
from synth.scene.placement import (
    PlacementArea,
    frustum,
    reaches_m,
    refuse_crowd,
    scatter,
    strew,
)
from synth.scene.population import draw_diameters_m
from synth.scene.settling import buried_fraction, lowest_side, lying_turn, shortest_turn
from synth.scene.thing_placement import place_things, reach_in_view_m
from synth.spec import SceneSpec, dataset_of, tints_of
from synth.spec.things import ThingsSpec
from synth.things.record import PlacedThing

# Children of the scene's seed.
_LYING, _GROUND, _POPULATION, _SHARED = 1, 2, 3, 12
_FINISH, _WETNESS, _THINGS = 31, 33, 34
_ROOM_M = 0.4  # kept free of a population's rocks round the foot of each station
_CROWD, _SAMPLE = 24, 12  # more rocks than the first are tried with the second before all are made
_FOOT_REACH = 0.6  # of a rock's radius: the ground so far round its centre makes it lean
_FOOT = 0.15  # vertices in this lowest share of a rock's height are its foot


@dataclass(frozen=True, eq=False)
class PlacedRock:
    """Placed rock: a rock and its pose in the world."""

    rock: RockModel
    model_to_world: Floats  # (3, 3) rotation
    position_m: Floats  # (3,), the centroid in the world
    albedo: float
    mesh: Mesh  # in the world
    buried_fraction: float = 0.0  # share of its volume below the ground
    finish: Finish = field(default_factory=Finish)


@dataclass(frozen=True, eq=False)
class _Standing:
    """Settled rock, on the vertical through the origin."""

    rock: RockModel
    turn: Floats  # (3, 3), model to world
    height_m: float  # of the centroid
    mesh: Mesh


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
    standing = _stood(rocks, ground, rng=rng, falling=falling, pool=pool)
    meshes = [one.mesh for one in standing]
    if counted:
        places_m = scatter(meshes, yard, rng=rng)
    else:
        places_m = strew(meshes, spec.population, keep_out_m=_feet_m(poses), rng=lying)
    albedos = rng.uniform(*spec.rocks.albedo, size=len(meshes))
    burials = lying.uniform(*spec.ground.burial, size=len(meshes))
    finishes = draw_finishes(tints_of(spec), len(meshes), rng=_child(spec, index, _FINISH))
    placed = tuple(
        _lay(one, place, ground, burial=burial, albedo=float(albedo), finish=finish)
        for one, place, burial, albedo, finish in zip(
            standing, places_m, burials, albedos, finishes, strict=True
        )
    )
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


def _onto(ground: SceneGround) -> Floats:
    """Rotation that lays what stands upright onto the slope."""
    return shortest_turn(np.array([0.0, 0.0, 1.0]), ground.normal())


def _stood(
    rocks: Sequence[RockModel],
    ground: SceneGround,
    *,
    rng: np.random.Generator,
    falling: np.random.Generator | None,
    pool: Executor | None = None,
) -> list[_Standing]:
    """Rocks settled and turned onto the slope, on the vertical through the origin."""
    vertices_m = [rock.mesh.vertices_m for rock in rocks]
    if falling is not None:
        sides = [lowest_side(one_m, rng=falling) for one_m in vertices_m]
    else:
        sides = list((map if pool is None else pool.map)(lowest_side, vertices_m))
    return [_standing(rock, side, ground, rng) for rock, side in zip(rocks, sides, strict=True)]


def _standing(
    rock: RockModel, side: Floats, ground: SceneGround, rng: np.random.Generator
) -> _Standing:
    turn, height_m = lying_turn(side, yaw_rad=rng.uniform(0.0, 2.0 * np.pi)), -float(side[3])
    if ground.gradient.any():
        turn = _onto(ground) @ turn
    mesh = rock.mesh.moved(turn, np.array([0.0, 0.0, height_m]))
    return _Standing(rock=rock, turn=turn, height_m=height_m, mesh=mesh)


def _refuse_crowd(
    spec: SceneSpec, yard: PlacementArea, ground: SceneGround, *, rng: np.random.Generator
) -> None:
    """Raise SpecError if by far not all rocks fit: a few are made and laid over and over.

    With the scene's own seed they are of the scene's own forms.
    """
    sample = quarry(msgspec.structs.replace(spec.rocks, count=_SAMPLE), rng=rng)
    meshes = [one.mesh for one in _stood(sample, ground, rng=rng, falling=None)]
    refuse_crowd(spec.rocks.count, meshes, yard, rng=rng)


def _reach_m(standing: _Standing) -> float:
    """Half the breadth of a rock's foot, or nearly."""
    return _FOOT_REACH * float(reaches_m([standing.mesh])[0])


def _lay(
    standing: _Standing,
    place_m: Floats,
    ground: SceneGround,
    *,
    burial: float,
    albedo: float,
    finish: Finish,
) -> PlacedRock:
    """Rock lying at a place: on the plane, on uneven ground to the mean depth of its foot.

    `burial` is the share of its height above the lowest point that sinks below the ground.
    """
    rock, turn, above_m = standing.rock, standing.turn, standing.height_m
    lean = ground.lean(place_m, _reach_m(standing))
    if lean is not None:
        turn = shortest_turn(ground.normal(), lean) @ turn
    if ground.gradient.any() or not ground.even or burial:
        start = np.array([place_m[0], place_m[1], 0.0])
        body = rock.mesh.moved(turn, start).vertices_m
        clearances_m = body[:, 2] - ground.heights_m(body[:, :2])
        low_m, tall_m = float(clearances_m.min()), float(np.ptp(clearances_m))
        if not ground.even:
            foot = body[body[:, 2] <= body[:, 2].min() + _FOOT * np.ptp(body[:, 2])]
            low_m += float(ground.unevenness_m(foot[:, :2]).std())
        above_m = burial * -tall_m - low_m
    position_m = np.array([place_m[0], place_m[1], above_m])
    mesh = rock.mesh.moved(turn, position_m)
    clearances_m = mesh.vertices_m[:, 2] - ground.heights_m(mesh.vertices_m[:, :2])
    return PlacedRock(
        rock=rock,
        model_to_world=turn,
        position_m=position_m,
        albedo=min(1.0, albedo * finish.brightness),
        mesh=mesh,
        buried_fraction=buried_fraction(
            mesh, np.where(clearances_m > -1e-9, np.maximum(clearances_m, 0.0), clearances_m)
        ),
        finish=finish,
    )
