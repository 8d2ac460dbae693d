"""Ground record: plane, undulation and noise model, estimated once for an observation."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rockshape.ground.plane import Plane
from rockshape.ground.range_noise import Noise, estimate_noise
from rockshape.ground.robust import fit_inverse_depth
from rockshape.ground.undulation import Swell, fit_swell, undulates

SAMPLES = 65_536  # points the ground is fitted to: one for each 4 x 4 pixels of a large frame
FINE_SAMPLES = 262_144  # and where it undulates
EVERY = 3  # of the samples for the plane, which a few thousand determine
MIN_POINTS = 50


@dataclass(frozen=True, eq=False)
class Ground:
    """Ground surface under the rocks, and the noise of what is measured on it.

    The published method's ground is the plane alone.
    """

    plane: Plane
    noise: Noise | None = None  # None: not estimated, and range is taken to be exact
    swell: Swell | None = None  # None: the plane is all there is

    def height_m(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Heights (...) above the ground of points (..., 3) in the camera frame."""
        height = self.plane.height_m(points_m)
        return height if self.swell is None else height - self.swell.height_m(points_m)


def fit_ground(points_m: NDArray[np.float64], *, pixel_rad: float) -> Ground | None:
    """The ground under rocks, for points (rows, cols, 3) in the camera frame, NaN where unknown.

    The plane is fitted in inverse depth (see `robust`); the noise is what points below it scatter
    by (see `noise`); where the ground undulates by more than that, a smooth surface is laid over
    the plane (see `smooth`). pixel_rad is a pixel's angle. None where too few points lie in front
    of the camera or no plane is determined.
    """
    points = _sampled(points_m, SAMPLES)
    if len(points) < MIN_POINTS:
        return None
    rays = points / points[:, 2:]
    found = fit_inverse_depth(rays[::EVERY], 1 / points[::EVERY, 2])
    if found is None:
        return None
    length = float(np.linalg.norm(found.coefficients))
    if length == 0:
        return None
    # the camera, at the origin, is above: its height -offset is positive
    normal, offset_m = -found.coefficients / length, -1 / length
    height = points @ normal - offset_m
    slant = np.abs(rays @ normal)
    noise = estimate_noise(height, points[:, 2], slant, pixel_rad=pixel_rad)
    swell = None
    if undulates(points, normal=normal, height_m=height, noise=noise):
        fine = _sampled(points_m, FINE_SAMPLES)
        swell = fit_swell(fine, normal=normal, height_m=fine @ normal - offset_m, noise=noise)
    if swell is not None:
        height = height - swell.height_m(points)
        noise = estimate_noise(height, points[:, 2], slant, pixel_rad=pixel_rad)
        noise = replace(noise, rough_m=float(np.hypot(noise.rough_m, swell.misfit_m)))
    near = np.abs(height) <= 3 * noise.height_m(points[:, 2], slant)
    sigma_m = float(height[near].std()) if near.any() else float("nan")
    plane = Plane(normal=normal, offset_m=offset_m, sigma_m=sigma_m, accepted=found.accepted)
    return Ground(plane=plane, noise=noise, swell=swell)


def _sampled(points_m: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """About so many points (n, 3) in front of the camera, evenly over the frame."""
    step = max(1, int(np.sqrt(points_m.shape[0] * points_m.shape[1] / count)))
    points = points_m[step // 2 :: step, step // 2 :: step].reshape(-1, 3)
    return points[np.isfinite(points).all(axis=1) & (points[:, 2] > 0)]
