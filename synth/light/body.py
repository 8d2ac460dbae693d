"""A body: one surface of a scene, as rays meet it and the painter sees it."""

from dataclasses import dataclass

from synth.geometry.mesh import Floats, Ints


@dataclass(frozen=True, eq=False)
class Body:
    """A surface in the world and what its albedo is painted on."""

    vertices_m: Floats  # (n, 3)
    faces: Ints  # (m, 3)
    normals: Floats  # (n, 3), outward unit normals
    albedo: float  # the mean over the surface
    model_to_world: Floats  # (3, 3), the texture turns with the body
    position_m: Floats  # (3,), and moves with it
