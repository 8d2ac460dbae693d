"""Lit scene: all its surfaces as triangles, ready to be rendered and shaded."""

from dataclasses import dataclass

from synth.arrays import Floats
from synth.light.body import Body
from synth.light.painter import Painter
from synth.spec.things import ThingName


@dataclass(frozen=True, eq=False)
class Stage:
    """Stage: rocks have labels, the ground's bodies have none; the painter makes the image.

    Things, which are no rocks, follow the rocks in a renderer's labels.
    """

    rocks: tuple[Body, ...]
    ground: tuple[Body, ...]
    plane_normal: Floats  # (3,), of the plane through the origin that the ground is or follows
    rise_m: float  # how far the ground rises above that plane
    painter: Painter
    drop_m: float = 0.0  # how far it falls below that plane
    hiding: bool = False  # whether the ground may hide parts of any rock
    things: tuple[Body, ...] = ()
    thing_kinds: tuple[ThingName, ...] = ()  # of each
