"""Laying of rocks: settled, turned onto the ground's slope and sunk in where they are placed."""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace

import numpy as np

from synth.arrays import Floats
from synth.geometry.mesh import Mesh
from synth.rocks import RockModel
from synth.scene.finish import Finish
from synth.scene.ground import SceneGround
from synth.scene.placement import reaches_m
from synth.scene.settling import buried_fraction, lowest_side, lying_turn, shortest_turn

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
class Standing:
    """Settled rock, on the vertical through the origin."""

    rock: RockModel
    turn: Floats  # (3, 3), model to world
    height_m: float  # of the centroid
    mesh: Mesh


def stood(
    rocks: Sequence[RockModel],
    ground: SceneGround,
    *,
    rng: np.random.Generator,
    falling: np.random.Generator | None,
    pool: Executor | None = None,
) -> list[Standing]:
    """Rocks settled and turned onto the slope, on the vertical through the origin."""
    vertices_m = [rock.mesh.vertices_m for rock in rocks]
    if falling is not None:
        sides = [lowest_side(one_m, rng=falling) for one_m in vertices_m]
    else:
        sides = list((map if pool is None else pool.map)(lowest_side, vertices_m))
    return [_standing(rock, side, ground, rng) for rock, side in zip(rocks, sides, strict=True)]


def _standing(
    rock: RockModel, side: Floats, ground: SceneGround, rng: np.random.Generator
) -> Standing:
    turn, height_m = lying_turn(side, yaw_rad=rng.uniform(0.0, 2.0 * np.pi)), -float(side[3])
    if ground.gradient.any():
        turn = _onto(ground) @ turn
    mesh = rock.mesh.moved(turn, np.array([0.0, 0.0, height_m]))
    return Standing(rock=rock, turn=turn, height_m=height_m, mesh=mesh)


def _onto(ground: SceneGround) -> Floats:
    """Rotation that lays what stands upright onto the slope."""
    return shortest_turn(np.array([0.0, 0.0, 1.0]), ground.normal())


def _reach_m(standing: Standing) -> float:
    """Half the breadth of a rock's foot, or nearly."""
    return _FOOT_REACH * float(reaches_m([standing.mesh])[0])


def lay(
    standing: Standing,
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
    return PlacedRock(
        rock=rock,
        model_to_world=turn,
        position_m=position_m,
        albedo=min(1.0, albedo * finish.brightness),
        mesh=mesh,
        buried_fraction=_buried_fraction(mesh, ground),
        finish=finish,
    )


def sunk(placed: PlacedRock, ground: SceneGround) -> PlacedRock:
    """Rock where it lies, on another ground."""
    return replace(placed, buried_fraction=_buried_fraction(placed.mesh, ground))


def _buried_fraction(mesh: Mesh, ground: SceneGround) -> float:
    clearances_m = mesh.vertices_m[:, 2] - ground.heights_m(mesh.vertices_m[:, :2])
    return buried_fraction(
        mesh, np.where(clearances_m > -1e-9, np.maximum(clearances_m, 0.0), clearances_m)
    )
