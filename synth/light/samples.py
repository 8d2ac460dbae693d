"""Surface samples as the camera sees them, and the size of a pixel there."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Singles
from synth.camera.camera import RenderCamera

Indices = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Samples:
    """Surface samples as the camera sees them."""

    points_m: Singles  # (n, 3), in the world
    normals: Singles  # (n, 3)
    body: Indices  # (n,), rocks first, then the ground's bodies
    directions: Singles  # (n, 3), from the eye, z-depth 1
    width_m: Singles  # (n,), a sample's breadth on the surface
    stretch: Singles  # (n,), its length over its breadth, along the line of sight

    def lengths_m(self) -> Singles:
        """Samples' lengths on the surface as vectors, (n, 3), away from the eye."""
        sights, normals = self.directions, self.normals
        away = sights - np.einsum("ij,ij->i", sights, normals)[:, None] * normals
        size = np.sqrt(np.einsum("ij,ij->i", away, away))
        away *= (self.width_m * self.stretch / np.maximum(size, np.float32(1e-6)))[:, None]
        return np.asarray(away)


def width_m(camera: RenderCamera, depth: Singles) -> Singles:
    """Pixel's breadth at a z-depth, (n,)."""
    return np.asarray(depth / np.float32(np.sqrt(camera.fx * camera.fy)))


def stretch(facing: Singles) -> Singles:
    """Anisotropy of a pixel on surfaces, length over width, (n,), at most 50."""
    return np.asarray(1.0 / np.maximum(-facing, np.float32(0.02)))
