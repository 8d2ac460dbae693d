"""Star-shaped bodies: surfaces that each ray from the middle meets once, convex or not."""

from synth.rocks.star.cuts import Cuts, convex_core
from synth.rocks.star.rock import Made, fitted, star_rock
from synth.rocks.star.surface import StarSurface, star_mesh
from synth.rocks.star.waves import Waves, draw_waves

__all__ = [
    "Cuts",
    "Made",
    "StarSurface",
    "Waves",
    "convex_core",
    "draw_waves",
    "fitted",
    "star_mesh",
    "star_rock",
]
