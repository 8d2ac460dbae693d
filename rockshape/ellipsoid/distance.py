"""Distances between points and an ellipsoid: orthogonal, and the bidirectional Hausdorff."""

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid.half_axes import Ellipsoid

MAX_ROUNDS = 100
GOLDEN = (1 + 5**0.5) / 2


def nearest_on(ellipsoid: Ellipsoid, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """The nearest point (n, 3) of the ellipsoid's surface to each point (n, 3).

    In own axes the nearest point of y is x_k = s_k² y_k / (t + s_k²), where t solves
    Σ (s_k y_k / (t + s_k²))² = 1. The sum is convex and falls for t > -c², so that Newton's method
    from the left end -c² + c |y_c| climbs to the root and never passes it. Of the two nearest
    points to one on the longer axes' plane inside the evolute the one on the positive side is
    given.

    Source: Hart (1994), in Graphics Gems IV; the left end as in Eberly (2013).
    """
    axes = ellipsoid.half_axes_m
    own = (points_m - ellipsoid.centre_m) @ ellipsoid.axes.T
    folded = np.abs(own) / axes[2]
    ratio = axes / axes[2]
    # a point on a plane of symmetry is moved off it by a rounding error, which picks a side
    folded = np.maximum(folded, 1e-14)
    shift = folded[:, 2] - 1
    for _ in range(MAX_ROUNDS):
        share = ratio * folded / (shift[:, None] + ratio**2)
        excess = (share**2).sum(axis=1) - 1
        slope = -2 * (share**2 / (shift[:, None] + ratio**2)).sum(axis=1)
        step = np.where(excess > 0, -excess / slope, 0.0)
        shift = shift + step
        if np.all(step <= 1e-15 * (1 + np.abs(shift))):
            break
    share = ratio * folded / (shift[:, None] + ratio**2)
    share /= np.linalg.norm(share, axis=1, keepdims=True)
    return ellipsoid.from_sphere(np.where(own < 0, -share, share))


def orthogonal_distance_m(
    ellipsoid: Ellipsoid, points_m: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Signed distances (n,) of points (n, 3) to the nearest point of the surface, outside positive.

    The radial distance is never shorter; how much longer it is grows with a/c.
    """
    distance = np.linalg.norm(points_m - nearest_on(ellipsoid, points_m), axis=1)
    outside = np.linalg.norm(ellipsoid.to_sphere(points_m), axis=1) >= 1
    return np.asarray(np.where(outside, distance, -distance))


def surface_points_m(ellipsoid: Ellipsoid, count: int) -> NDArray[np.float64]:
    """Points (count, 3) spread over the surface: a Fibonacci lattice on the sphere, stretched."""
    place = np.arange(count) + 0.5
    height = 1 - 2 * place / count
    turn_rad = 2 * np.pi * place / GOLDEN
    across = np.sqrt(1 - height**2)
    return ellipsoid.from_sphere(
        np.column_stack([across * np.cos(turn_rad), across * np.sin(turn_rad), height])
    )


def hausdorff_m(
    ellipsoid: Ellipsoid, points_m: NDArray[np.float64], *, samples: int = 4096
) -> float:
    """D_H: the larger of the two farthest nearest distances between points and surface, in m.

    max(h(P, E), h(E, P)) with h(A, B) = max over a of min over b of |a - b|. The surface's side of
    it is taken on `samples` points spread over the ellipsoid, and falls short of the whole surface
    by at most their spacing, about a √(4π/samples). From one side the far half of an ellipsoid has
    no points: D_H is then about the ellipsoid's depth, whatever the fit on the near side.

    NaN for no points. Source: Fox et al. (2002), equations 9 and 10.
    """
    from scipy.spatial import cKDTree  # noqa: PLC0415 - a third of a second that few callers need

    if len(points_m) == 0:
        return float("nan")
    from_points = float(np.abs(orthogonal_distance_m(ellipsoid, points_m)).max())
    nearest, _ = cKDTree(points_m).query(surface_points_m(ellipsoid, samples))
    return max(from_points, float(nearest.max()))
