"""The ground plane by three-sigma rejection, as published."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

REJECT_SIGMA = 3.0
MAX_ROUNDS = 50


@dataclass(frozen=True, eq=False)
class Plane:
    """The plane of points p with normal . p = offset; the camera, at the origin, is above it."""

    normal: NDArray[np.float64]  # (3,), unit length, towards the camera's side
    offset_m: float
    sigma_m: float  # standard deviation of the accepted points' heights
    accepted: float  # share of the points that the fit was made on

    def height_m(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Heights (...) above the plane of points (..., 3)."""
        return points_m @ self.normal - self.offset_m


def fit_plane(points_m: NDArray[np.float64]) -> Plane | None:
    """Least-squares plane with 3-sigma rejection.

    The plane is fitted to every point; then those farther than three standard deviations from the
    mean are rejected and it is fitted again, until the set of points no longer changes (Fox et al.
    2002, section 2, Rock Segmentation). The residual is the orthogonal distance.

    points_m is (..., 3) in the camera frame, NaN where nothing was measured. None where fewer than
    three points are left or they lie on one line.

    The rejection takes rocks for ground once they cover much of the frame: on scenes of known
    ground the plane's bias grew from 0.03 cm at 19 % cover to 6.75 cm at 45 %.
    """
    x, y, z = np.moveaxis(points_m, -1, 0)
    known = np.isfinite(x) & np.isfinite(y) & np.isfinite(z)
    points = np.stack([x[known], y[known], z[known]])
    if points.shape[1] < 3:
        return None
    middle = points.mean(axis=1)
    points -= middle[:, None]
    keep = np.ones(points.shape[1], dtype=bool)
    count, total, squares = points.shape[1], np.zeros(3), points @ points.T
    for _ in range(MAX_ROUNDS):
        centre = total / count
        spread, axes = np.linalg.eigh(squares / count - np.outer(centre, centre))
        if spread[1] <= 1e-12 * spread[2]:
            return None
        normal = axes[:, 0] if axes[:, 0] @ (middle + centre) < 0 else -axes[:, 0]
        height = normal @ points - normal @ centre
        sigma = float(np.sqrt(np.mean(np.square(height[keep]))))
        now = np.abs(height) <= REJECT_SIGMA * sigma
        changed = np.flatnonzero(now != keep)
        left = count + 2 * int(now[changed].sum()) - len(changed)
        if left < 3 or len(changed) == 0:
            break
        # the sums of the kept points change by the few that came and went
        moved, sign = points[:, changed], np.where(now[changed], 1.0, -1.0)
        count, total = left, total + moved @ sign
        squares = squares + (moved * sign) @ moved.T
        keep = now
    return Plane(
        normal=normal,
        offset_m=float(normal @ (middle + centre)),
        sigma_m=sigma,
        accepted=float(keep.mean()),
    )
