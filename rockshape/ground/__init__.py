"""The ground under the rocks: the published plane, and one that holds among many rocks."""

from rockshape.ground.ground import Ground, fit_ground
from rockshape.ground.plane import Plane, fit_plane
from rockshape.ground.range_noise import Noise

__all__ = ["Ground", "Noise", "Plane", "fit_ground", "fit_plane"]
