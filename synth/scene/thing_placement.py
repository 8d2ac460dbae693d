"""Placement of things: on the ground, in view and clear of the rocks."""

from collections.abc import Sequence

import numpy as np

from synth.arrays import Floats
from synth.camera.camera import RenderCamera
from synth.errors import SpecError
from synth.geometry.mesh import Mesh
from synth.scene.ground import SceneGround
from synth.scene.settling import shortest_turn
from synth.spec.things import ThingName, ThingsSpec
from synth.things.meshes import tube
from synth.things.models import thing_model
from synth.things.record import PlacedThing, ThingModel

_DARTS = 600
_SHARE = 0.7  # of the half field of view at the scene's centre
_CUT, _FARTHER = ("wheel", "deck"), 1.8  # a rover's parts may be cut by the frame
_CABLE_RADIUS_M, _CABLE_STEP_M = 0.008, 0.02
_WANDER_RAD = 0.12  # of a cable's direction from a step to the next
_CABLE_RGB = (0.10, 0.10, 0.11)


def reach_in_view_m(camera: RenderCamera, distance_m: float) -> float:
    """Radius of the ground round the scene's centre that a view is sure to hold."""
    half = min(camera.width / camera.fx, camera.height / camera.fy) / 2.0
    return _SHARE * half * distance_m


def place_things(
    spec: ThingsSpec,
    ground: SceneGround,
    rocks: Sequence[Mesh],
    *,
    reach_m: float,
    rng: np.random.Generator,
) -> tuple[PlacedThing, ...]:
    """Things on the ground within a reach of the scene's centre, apart from rocks and each other.

    Raises:
        SpecError: one finds no place.
    """
    taken_m = np.array([_disc_m(mesh) for mesh in rocks]).reshape(-1, 3)
    placed: list[PlacedThing] = []
    for kind in spec.kinds:
        if kind == "mast-shadow":
            continue
        own = rng.spawn(1)[0]
        if kind == "cable":
            thing = _cable(spec, ground, taken_m, reach_m, own)
        else:
            farther_m = reach_m * (_FARTHER if kind in _CUT else 1.0)
            thing = _standing(thing_model(kind, spec), ground, taken_m, farther_m, own)
            taken_m = np.vstack([taken_m, _disc_m(thing.mesh)])
        placed.append(thing)
    return tuple(placed)


def _disc_m(mesh: Mesh) -> list[float]:
    """Middle and radius of a mesh in plan: x, y, r."""
    plan = mesh.vertices_m[:, :2]
    middle = (plan.min(axis=0) + plan.max(axis=0)) / 2.0
    return [*middle.tolist(), float(np.linalg.norm(plan - middle, axis=1).max())]


def _standing(
    model: ThingModel,
    ground: SceneGround,
    taken_m: Floats,
    reach_m: float,
    rng: np.random.Generator,
) -> PlacedThing:
    """Thing on the slope, turned at random, at the first free place; in ripples at mean height."""
    radius_m = _disc_m(model.mesh)[2]
    darts_m = reach_m * np.sqrt(rng.uniform(size=(_DARTS, 1))) * _directions(_DARTS, rng)
    gaps_m = np.linalg.norm(darts_m[:, None] - taken_m[:, :2], axis=2) - taken_m[:, 2]
    free = np.flatnonzero((gaps_m > radius_m).all(axis=1))
    if not len(free):
        raise _no_room(model.kind, reach_m)
    place_m = darts_m[free[0]]
    cosine, sine = _directions(1, rng)[0]
    yaw = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    turn = shortest_turn(np.array([0.0, 0.0, 1.0]), ground.normal()) @ yaw
    heights_m = model.mesh.vertices_m[:, 2]
    foot = model.mesh.vertices_m[heights_m < heights_m.min() + 1e-6]
    under_m = foot @ turn.T + np.array([*place_m, 0.0])
    height_m = float(np.mean(ground.heights_m(under_m[:, :2]) - under_m[:, 2]))
    position_m = np.array([*place_m, height_m])
    return PlacedThing(model, model.mesh.moved(turn, position_m), turn, position_m)


def _cable(
    spec: ThingsSpec, ground: SceneGround, taken_m: Floats, reach_m: float, rng: np.random.Generator
) -> PlacedThing:
    """Cable along a wandering line over the ground that passes between the rocks."""
    steps = max(4, round(spec.cable_m / _CABLE_STEP_M))
    for _ in range(_DARTS):
        start_m = reach_m * np.sqrt(rng.uniform()) * _directions(1, rng)[0]
        bends = np.cumsum(_WANDER_RAD * rng.standard_normal(steps))
        heading = rng.uniform(0.0, 2.0 * np.pi) + np.convolve(bends, np.full(9, 1 / 9), "same")
        strides = _CABLE_STEP_M * np.column_stack([np.cos(heading), np.sin(heading)])
        plan_m = start_m + np.cumsum(strides, axis=0) - strides.sum(axis=0) / 2.0
        gaps_m = np.linalg.norm(plan_m[:, None] - taken_m[:, :2], axis=2) - taken_m[:, 2]
        if (gaps_m > _CABLE_RADIUS_M).all():
            break
    else:
        raise _no_room("cable", reach_m)
    line_m = np.column_stack([plan_m, ground.heights_m(plan_m) + _CABLE_RADIUS_M])
    mesh = tube(line_m, _CABLE_RADIUS_M)
    model = ThingModel("cable", mesh, _CABLE_RGB)
    return PlacedThing(model, mesh, np.eye(3), np.zeros(3))


def _directions(count: int, rng: np.random.Generator) -> Floats:
    azimuth_rad = rng.uniform(0.0, 2.0 * np.pi, count)
    return np.column_stack([np.cos(azimuth_rad), np.sin(azimuth_rad)])


def _no_room(kind: ThingName, reach_m: float) -> SpecError:
    return SpecError(
        f"things.kinds: expected room for a {kind} between the rocks, "
        f"found none within {reach_m:.3g} m of the scene's centre"
    )
