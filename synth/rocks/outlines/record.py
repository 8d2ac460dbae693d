"""Outline truth record, forms whose outlines are known, and integrals over polygons."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from synth.arrays import Floats


@dataclass(frozen=True)
class OutlineTruth:
    """Truth of an outline: the shadow of a body under parallel rays, on a plane across them."""

    area_m2: float
    perimeter_m: float
    axis_ratio: float  # minor over major axis of the ellipse with the same second moments
    roundness: float  # Wadell's: mean radius of the corners over the inscribed disc's
    roundness_scale: float = 0.0  # of the smoothing before, over √(area/π); 0: as it is


class Form(Protocol):
    """Form in its rock's frame whose outlines are known."""

    def outline(self, across: Floats) -> OutlineTruth:
        """Outline on the plane of two rows of unit vectors across the rays, (2, 3)."""

    def caliper_half_axes_m(self) -> Floats:
        """Caliper half-axes L >= I >= S, (3,); see `synth.geometry.caliper`."""


def plane_across(ray: Floats) -> Floats:
    """Two unit vectors, (2, 3), that with the ray (3,) make a right-handed frame."""
    ray = ray / np.linalg.norm(ray)
    first = np.cross(ray, np.eye(3)[np.argmin(np.abs(ray))])
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(ray, first)])


def polygon_outline(
    points_m: Floats, *, roundness: float, roundness_scale: float = 0.0
) -> OutlineTruth:
    """Numbers of a polygon (n, 2), anticlockwise (Gauss's formulas)."""
    following = np.roll(points_m, -1, axis=0)
    crosses = points_m[:, 0] * following[:, 1] - points_m[:, 1] * following[:, 0]
    total = points_m + following
    area_m2 = float(crosses.sum() / 2.0)
    centre_m = crosses @ total / (6.0 * area_m2)
    squares = np.einsum("n,ni,nj->ij", crosses, points_m, points_m)
    squares += np.einsum("n,ni,nj->ij", crosses, following, following)
    squares += np.einsum("n,ni,nj->ij", crosses, total, total)
    return OutlineTruth(
        area_m2=area_m2,
        perimeter_m=float(np.linalg.norm(following - points_m, axis=1).sum()),
        axis_ratio=axis_ratio(squares / (24.0 * area_m2) - np.outer(centre_m, centre_m)),
        roundness=roundness,
        roundness_scale=roundness_scale,
    )


def axis_ratio(covariance_m2: Floats) -> float:
    """Axis ratio: minor over major axis of the ellipse with these second moments, (2, 2)."""
    low, high = np.linalg.eigvalsh(covariance_m2)
    return float(np.sqrt(low / high))
