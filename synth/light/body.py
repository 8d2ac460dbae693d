"""Body: one surface of a scene, as rays and the painter see it."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from synth.arrays import Floats, Ints, Singles

Paint = Callable[[Singles, Singles], Singles]
"""Factor (n, 3) on a body's reflectance in R, G, B at points (n, 3) of its own frame, averaged
over footprints (n,), both in metres."""

Relief = Callable[[Singles, Singles, Singles], Singles]
"""Unit normals (n, 3) with relief finer than a body's triangles, at points (n, 3) where the
triangles' normals are (n, 3), averaged over footprints (n,)."""


@dataclass(frozen=True, eq=False)
class Body:
    """Surface in the world, with the frame that its reflectance is defined in.

    Its linear reflectance in R, G, B is albedo × tint × paint; a grey picture has the luminance.
    """

    vertices_m: Floats  # (n, 3)
    faces: Ints  # (m, 3)
    normals: Floats  # (n, 3), outward unit normals
    albedo: float  # the mean over the surface, but for one whose paint has it all
    model_to_world: Floats  # (3, 3), the texture turns with the body
    position_m: Floats  # (3,), and moves with it
    tint: Floats = field(default_factory=lambda: np.ones(3))  # (3,), of luminance 1
    paint: Paint | None = None  # None: even
    painted_albedo: float = 1.0  # mean luminance of the paint over the surface
    relief: Relief | None = None  # None: none but the triangles'
