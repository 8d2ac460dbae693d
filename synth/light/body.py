"""Body: one surface of a scene, as rays and the painter see it."""

from dataclasses import dataclass

from synth.arrays import Floats, Ints


@dataclass(frozen=True, eq=False)
class Body:
    """Surface in the world, with the frame that its albedo is defined in."""

    vertices_m: Floats  # (n, 3)
    faces: Ints  # (m, 3)
    normals: Floats  # (n, 3), outward unit normals
    albedo: float  # the mean over the surface
    model_to_world: Floats  # (3, 3), the texture turns with the body
    position_m: Floats  # (3,), and moves with it
