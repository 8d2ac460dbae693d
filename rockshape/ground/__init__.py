"""The ground under the rocks: the published plane, and one that holds among many rocks."""

from rockshape.ground.ground import Ground, fit_ground
from rockshape.ground.noise_model import NoiseModel
from rockshape.ground.plane import Plane, fit_plane

__all__ = ["Ground", "NoiseModel", "Plane", "fit_ground", "fit_plane"]
