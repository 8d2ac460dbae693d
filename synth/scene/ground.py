"""Ground of a scene: plain, or rough."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Protocol

import numpy as np
from msgspec import UnsetType

from synth.arrays import Floats
from synth.geometry.mesh import Mesh
from synth.scene.pebbles import pebbles
from synth.scene.plain_ground import bare_ground
from synth.spec.ground import GroundSpec
from synth.terrain.make import RoughGround, rough_heights
from synth.terrain.skin import PebbleSkin, Skin


class SceneGround(Protocol):
    """Ground of a scene: what rocks settle on, and what renderers and the painter see."""

    @property
    def gradient(self) -> Floats:
        """Mean slope, (2,)."""

    @property
    def even(self) -> bool:
        """Whether it is a plane."""

    def rise_m(self, meshes: Sequence[Mesh]) -> float:
        """Height of the ground's meshes above the plane of its mean slope, near the rocks."""

    @property
    def drop_m(self) -> float:
        """Depth below that plane that counts for the farthest ground in view."""

    @property
    def hiding(self) -> bool:
        """Whether it may hide parts of any rock, by its relief or where rocks are sunk in it."""

    @property
    def haze_m(self) -> float | None:
        """Distance that veils 63 % of what is seen through the air; None: clear."""

    def heights_m(self, places_m: Floats) -> Floats:
        """Heights z at places (..., 2)."""

    def foot_m(self, places_m: Floats) -> Floats:
        """Heights at which rocks at places (..., 2) are looked for in views."""

    def unevenness_m(self, places_m: Floats) -> Floats:
        """Heights above the plane at places (..., 2)."""

    def lean(self, place_m: Floats, reach_m: float) -> Floats | None:
        """Unit normal (3,) that a rock at a place leans along; None: that of the mean slope."""

    def plane_normal(self) -> Floats | None:
        """Unit normal, (3,), where the ground is a plane through the origin."""

    def normal(self) -> Floats:
        """Unit normal of the mean slope, (3,)."""

    def behind(self, meshes: Sequence[Mesh], *, rng: np.random.Generator) -> "SceneGround":
        """Ground with what the wind leaves behind rocks with these meshes; itself: nothing."""

    def meshes(self) -> tuple[Mesh, ...]:
        """Surface first, then pebbles if there are any."""

    def skins(self) -> tuple[Skin | None, ...]:
        """Skin of each mesh; None: the ground's even albedo."""


def make_ground(spec: GroundSpec, *, radius_m: float, rng: np.random.Generator) -> SceneGround:
    """Ground, its relief and pebbles within a radius of the scene's centre.

    Raises:
        SpecError: too many pebbles, or an elevation model that cannot be used.
    """
    bare = bare_ground(spec, radius_m=radius_m, rng=rng)
    if isinstance(spec.terrain, UnsetType):
        stones = pebbles(spec, bare.heights_m, radius_m=radius_m, rng=rng)
        return replace(bare, stones=stones)
    relief, loose = rng.spawn(2)
    grid, skin = rough_heights(spec.terrain, under_m=bare.heights_m, radius_m=radius_m, rng=relief)
    return RoughGround(
        grid=grid,
        gradient=bare.gradient,
        radius_m=radius_m,
        soil=skin,
        pebble=PebbleSkin(spec.terrain.pebble),
        stones=pebbles(spec, grid.heights_m, radius_m=radius_m, rng=loose, beyond=True),
        spec=spec.terrain,
    )
