"""Ground record: plane, undulation and noise model, estimated once for an observation."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rockshape.ground.noise_model import NoiseModel
from rockshape.ground.plane import Plane
from rockshape.ground.range_noise import ROWS, estimate_range_noise, estimate_roughness
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
    noise: NoiseModel | None = None  # None: not estimated, and range is taken to be exact
    swell: Swell | None = None  # None: the plane is all there is

    def height_m(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Heights (...) above the ground of points (..., 3) in the camera frame."""
        height = self.plane.height_m(points_m)
        return height if self.swell is None else height - self.swell.height_m(points_m)


def fit_ground(points_m: NDArray[np.float64], *, pixel_rad: float) -> Ground | None:
    """Ground under rocks, of points (rows, cols, 3) in the camera frame, NaN where unknown.

    The plane is fitted in inverse depth (`robust`); the range's noise is estimated from residuals
    about it (`range_noise`); where the ground undulates by more than that, a smooth surface is laid
    over the plane (`undulation`); what scatters about the surface beyond the range's noise is the
    ground's roughness. pixel_rad is a pixel's angle. None where too few points lie in front of the
    camera or no plane is determined.
    """
    step = _step(points_m, SAMPLES)
    points = _sampled(points_m, step)
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
    plane = Plane(
        normal=-found.coefficients / length,
        offset_m=-1 / length,
        sigma_m=float("nan"),
        accepted=found.accepted,
    )
    noise, swell = _range_noise(points_m, plane, pixel_rad=pixel_rad), None
    if undulates(points, plane=plane, noise=noise, pixels_each=step**2):
        fine = _step(points_m, FINE_SAMPLES)
        swell = fit_swell(_sampled(points_m, fine), plane=plane, noise=noise, pixels_each=fine**2)
    height = Ground(plane, noise, swell).height_m(points)
    slant = np.abs(rays @ plane.normal)
    rough_m = estimate_roughness(
        height, points[:, 2] ** 2 * slant, range_sd_per_m=noise.inverse_depth_sd_per_m
    )
    if swell is not None:
        rough_m = float(np.hypot(rough_m, swell.misfit_m))
    noise = replace(noise, rough_m=rough_m)
    near = np.abs(height) <= 3 * noise.height_sd_m(points[:, 2], slant)
    sigma_m = float(height[near].std()) if near.any() else float("nan")
    return Ground(replace(plane, sigma_m=sigma_m), noise, swell)


def _range_noise(points_m: NDArray[np.float64], plane: Plane, *, pixel_rad: float) -> NoiseModel:
    """Noise of range about a plane, on ground that is not rough, from whole rows of the frame.

    A point at z-depth Z stands h over the plane n·p = o; its ray meets the plane at Z o/(o + h), so
    that 1/Z is h/(-o Z) greater than there.
    """
    step = max(1, points_m.shape[0] // ROWS)
    points = points_m[step // 2 :: step]
    depth = points[..., 2]
    lever = np.where(depth > 0, -plane.offset_m * depth, np.nan)
    sd_per_m, window_px = estimate_range_noise(plane.height_m(points) / lever, lever)
    return NoiseModel(sd_per_m, window_px, 0.0, pixel_rad)


def _step(points_m: NDArray[np.float64], count: int) -> int:
    """Step in rows and columns that leaves about so many points."""
    return max(1, int(np.sqrt(points_m.shape[0] * points_m.shape[1] / count)))


def _sampled(points_m: NDArray[np.float64], step: int) -> NDArray[np.float64]:
    """Points (n, 3) in front of the camera, at every so-many'th row and column."""
    points = points_m[step // 2 :: step, step // 2 :: step].reshape(-1, 3)
    return points[np.isfinite(points).all(axis=1) & (points[:, 2] > 0)]
