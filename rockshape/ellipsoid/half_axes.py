"""An ellipsoid in space."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Ellipsoid:
    """An ellipsoid: p on it where |diag(1/half_axes) axes (p - centre)| = 1."""

    centre_m: NDArray[np.float64]  # (3,)
    half_axes_m: NDArray[np.float64]  # (3,), a >= b >= c
    axes: NDArray[np.float64]  # (3, 3), unit vectors in rows, in the order of half_axes_m

    def to_sphere(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (..., 3) where the ellipsoid is the unit sphere and its axes are x, y and z."""
        return np.asarray((points_m - self.centre_m) @ self.axes.T / self.half_axes_m)

    def from_sphere(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (..., 3) in metres of points of the frame where the ellipsoid is a sphere."""
        return np.asarray(self.centre_m + (points * self.half_axes_m) @ self.axes)

    def radial_distance_m(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Signed distances (n,) of points (n, 3), outside positive, along the ray from the centre.

        |p| (1 - 1/sqrt(q)) with p the vector from the centre and q its squared length in units of
        the half-axes. A point at the centre lies -c away.
        """
        own = (points_m - self.centre_m) @ self.axes.T
        length = np.linalg.norm(own, axis=1)
        level = np.linalg.norm(own / self.half_axes_m, axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = length * (1 - 1 / level)
        return np.asarray(np.where(level > 0, distance, -self.half_axes_m[2]))

    def support_m(self, normals: NDArray[np.float64]) -> NDArray[np.float64]:
        """How far the ellipsoid reaches along unit vectors (..., 3), from the origin: max n . p."""
        reach = np.linalg.norm(normals @ self.axes.T * self.half_axes_m, axis=-1)
        return np.asarray(normals @ self.centre_m + reach)
