"""Lidar: ranges along scan lines of even angles, with nothing between them."""

from typing import Annotated

import numpy as np
from msgspec import Meta, Struct

from synth.arrays import Floats, Ints
from synth.camera.camera import RenderCamera
from synth.camera.projection import border_rays, project
from synth.sensor.echo import Echo, echo_of, ray_lengths
from synth.sensor.sensor import Capture, Sensor, SensorInput


class LidarOptions(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Lidar at the camera's place, its scan lines level with the camera's rows."""

    line_deg: Annotated[float, Meta(gt=0, le=90)] = 0.4  # from a scan line to the next
    step_deg: Annotated[float, Meta(gt=0, le=90)] = 0.1  # from a shot to the next in a line
    sd_m: Annotated[float, Meta(ge=0, le=1)] = 0.01  # noise along the ray
    step_m: Annotated[float, Meta(ge=0, le=1)] = 0.001  # of the range that is told; 0: none
    photons: Annotated[float, Meta(gt=0)] = 2000.0  # mean count from a white, facing one at 1 m


def shot_pixels(camera: RenderCamera, options: LidarOptions) -> tuple[Ints, Ints]:
    """Rows and columns (n,) of the pixels in which shots land, each pixel once.

    Line k has the elevation k × line_deg from the camera's x-z plane, shot j in it the azimuth
    j × step_deg about the camera's y axis, both from the optical axis.
    """
    rays = np.concatenate(border_rays(camera))
    azimuths = _multiples(np.arctan(rays[:, 0]), np.deg2rad(options.step_deg))
    elevations = _multiples(
        np.arctan2(rays[:, 1], np.hypot(1.0, rays[:, 0])), np.deg2rad(options.line_deg)
    )
    azimuth, elevation = np.meshgrid(azimuths, elevations)
    points = np.stack([np.tan(azimuth), np.tan(elevation) / np.cos(azimuth)], axis=-1)
    ahead = np.concatenate([points, np.ones_like(points[..., :1])], axis=-1).reshape(-1, 3)
    column, row = np.rint(project(camera, ahead)).astype(np.int64).T
    inside = (column >= 0) & (column < camera.width) & (row >= 0) & (row < camera.height)
    pixels = np.unique(row[inside] * camera.width + column[inside])
    rows, columns = np.divmod(pixels, camera.width)
    return rows, columns


def _multiples(angles: Floats, step: float) -> Floats:
    """Multiples of a step between the least and the greatest angle."""
    return step * np.arange(np.ceil(angles.min() / step), np.floor(angles.max() / step) + 1.0)


def lidar_range_m(
    echo: Echo, rows: Ints, columns: Ints, options: LidarOptions, *, rng: np.random.Generator
) -> Floats:
    """Range along the rays, (rows, cols), NaN but where a shot came back.

    The number of photons is Poisson's with the mean n = photons × ρ cos θ/r²; without any, whose
    probability is e⁻ⁿ, the shot is lost: far, dark and grazing surfaces drop out.
    """
    range_m = echo.range_m[rows, columns]
    count = rng.poisson(options.photons * echo.signal[rows, columns])
    found_m = range_m + options.sd_m * rng.standard_normal(range_m.shape)
    if options.step_m > 0.0:
        found_m = options.step_m * np.rint(found_m / options.step_m)
    image_m = np.full(echo.range_m.shape, np.nan)
    image_m[rows, columns] = np.where((count > 0) & (found_m > 0.0), found_m, np.nan)
    return image_m


def _capture(shot: SensorInput) -> Capture:
    rows, columns = shot_pixels(shot.camera, shot.options)
    range_m = lidar_range_m(echo_of(shot), rows, columns, shot.options, rng=shot.random("lidar"))
    return Capture(picture=shot.picture, depth_m=range_m / ray_lengths(shot.camera))


LIDAR = Sensor("lidar", "scan lines of a lidar, with dropouts", _capture, options=LidarOptions)
