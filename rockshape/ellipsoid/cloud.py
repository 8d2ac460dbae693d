"""Cloud of points, centred and scaled to size 1, with its principal axes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid.half_axes import Ellipsoid
from rockshape.ellipsoid.parameters import State

MIN_POINTS = 30  # nine unknowns and some to spare


@dataclass(frozen=True, eq=False)
class Cloud:
    """Points (n, 3) less their centroid over their size, the greatest distance from it."""

    points: NDArray[np.float64]  # (n, 3)
    centroid_m: NDArray[np.float64]  # (3,)
    size_m: float
    spread: NDArray[np.float64]  # (3,), variances of the scaled points, ascending
    directions: NDArray[np.float64]  # (3, 3), in columns

    def scaled(self, ellipsoid_m: Ellipsoid) -> Ellipsoid:
        """Ellipsoid of the scaled points that one of the points is."""
        return Ellipsoid(
            centre_m=(ellipsoid_m.centre_m - self.centroid_m) / self.size_m,
            half_axes_m=ellipsoid_m.half_axes_m / self.size_m,
            axes=ellipsoid_m.axes,
        )

    def in_metres(self, ellipsoid: Ellipsoid) -> Ellipsoid:
        """Ellipsoid of the points that one of the scaled points is."""
        return Ellipsoid(
            centre_m=self.centroid_m + self.size_m * ellipsoid.centre_m,
            half_axes_m=self.size_m * ellipsoid.half_axes_m,
            axes=ellipsoid.axes,
        )

    def starting_states(self, view: NDArray[np.float64]) -> list[State]:
        """Centres at and behind the visible surface, with the cloud's own axes.

        A cap of a sphere seen from outside has its centre behind its centroid, so the starts move
        the centre along the view (3,) by none, a half and one standard length of the cloud.
        """
        deviations = np.sqrt(np.maximum(self.spread, 1e-6))
        axes = np.maximum(np.sqrt(3) * deviations, np.sqrt(3) * deviations[2] / 3)
        rotation = self.directions * np.sign(np.linalg.det(self.directions))
        return [
            State(centre=back * deviations[2] * view, log_axes=np.log(axes), rotation=rotation)
            for back in (0.0, 0.5, 1.0)
        ]


def cloud_of(points_m: NDArray[np.float64]) -> Cloud | None:
    """Cloud of points (n, 3); None for fewer than 30, or where they lie in one plane."""
    if len(points_m) < MIN_POINTS:
        return None
    centroid = points_m.mean(axis=0)
    spread, directions = np.linalg.eigh(np.cov(points_m.T, bias=True))
    if spread[0] <= 1e-12 * spread[2]:
        return None
    size = float(np.sqrt(((points_m - centroid) ** 2).sum(axis=1).max()))
    return Cloud((points_m - centroid) / size, centroid, size, spread / size**2, directions)
