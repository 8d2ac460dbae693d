"""Models of things: their sizes, colours and shapes."""

from collections.abc import Callable, Mapping

import numpy as np

from synth.spec.things import ThingName, ThingsSpec
from synth.things.meshes import ball, box, disc_outline, joined, prism
from synth.things.record import ThingModel

_RULER_M, _STRIPE_M = (0.03, 0.006), 0.01  # breadth and thickness; a stripe
_WHEEL_M, _TREAD_M, _TREADS = (0.25, 0.18), 0.012, 18  # radius and breadth; grousers
_DECK_M, _DECK_HEIGHT_M, _BODY = (0.8, 0.55, 0.03), 0.3, 0.8  # plate; its place; body's share
_COIN_M = (0.0125, 0.002)  # radius and thickness
_BALL_M = 0.03  # radius


def thing_model(kind: ThingName, spec: ThingsSpec) -> ThingModel:
    """Thing of a kind in its own frame; cables and shadows have none."""
    return _MODELS[kind](spec)


def _ruler(spec: ThingsSpec) -> ThingModel:
    mesh = box((spec.ruler_m, *_RULER_M))
    return ThingModel("ruler", mesh, (0.8, 0.8, 0.78), stripe_m=_STRIPE_M)


def _wheel(_: ThingsSpec) -> ThingModel:
    radius_m, breadth_m = _WHEEL_M
    outline = disc_outline(radius_m, 4 * _TREADS)
    outline *= np.repeat([[1.0], [1.0 - _TREAD_M / radius_m]], 2, axis=0)[
        np.arange(4 * _TREADS) % 4
    ]
    lying = prism(outline, -breadth_m / 2.0, breadth_m / 2.0)
    upright = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    mesh = lying.moved(upright, np.array([0.0, 0.0, radius_m]))
    return ThingModel("wheel", mesh, (0.30, 0.30, 0.31))


def _deck(_: ThingsSpec) -> ThingModel:
    across_m, along_m, _thick = _DECK_M
    plate = box(_DECK_M, base_m=_DECK_HEIGHT_M)
    body = box((_BODY * across_m, _BODY * along_m, _DECK_HEIGHT_M))
    return ThingModel("deck", joined([plate, body]), (0.62, 0.56, 0.42))


def _coin(_: ThingsSpec) -> ThingModel:
    radius_m, thick_m = _COIN_M
    return ThingModel("coin", prism(disc_outline(radius_m, 48), 0.0, thick_m), (0.55, 0.36, 0.24))


def _ball(_: ThingsSpec) -> ThingModel:
    return ThingModel("ball", ball(_BALL_M), (0.75, 0.16, 0.10))


_MODELS: Mapping[ThingName, Callable[[ThingsSpec], ThingModel]] = {
    "ruler": _ruler,
    "wheel": _wheel,
    "deck": _deck,
    "coin": _coin,
    "ball": _ball,
}
