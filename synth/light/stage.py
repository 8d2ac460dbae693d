"""The stage: all surfaces of a scene as triangles, ready to be measured and painted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from synth.mesh import Floats, Ints

if TYPE_CHECKING:
    from synth.light.painter import Painter


@dataclass(frozen=True, eq=False)
class Body:
    """A surface in the world and what its albedo is painted on."""

    vertices_m: Floats  # (n, 3)
    faces: Ints  # (m, 3)
    normals: Floats  # (n, 3), outward unit normals
    albedo: float  # the mean over the surface
    model_to_world: Floats  # (3, 3), the texture turns with the body
    position_m: Floats  # (3,), and moves with it


@dataclass(frozen=True, eq=False)
class Stage:
    """Rocks have labels, the ground's bodies have none; the painter makes the image."""

    rocks: tuple[Body, ...]
    ground: tuple[Body, ...]
    plane_normal: Floats  # (3,), of the plane through the origin that the ground is or follows
    rise_m: float  # how far the ground rises above that plane
    painter: Painter
