"""A scanning lidar: range along every n-th row, with noise, up to a greatest distance."""

import numpy as np
from msgspec import Struct

from synth.sensor import Capture, Sensor, SensorInput, register_sensor


class LidarOptions(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The table [noise.options]."""

    rows_apart: int = 4
    sd_m: float = 0.01
    farthest_m: float = 20.0


def capture(shot: SensorInput) -> Capture:
    options: LidarOptions = shot.options
    exact_m = shot.view.depth_m
    depth_m = exact_m + options.sd_m * shot.random("lidar").standard_normal(exact_m.shape)
    scanned = np.zeros(exact_m.shape, dtype=bool)
    scanned[:: options.rows_apart] = True
    seen = scanned & (exact_m <= options.farthest_m)
    intensity = np.where(seen, shot.view.image, 0).astype(np.uint8)
    return Capture(
        picture=shot.picture,
        depth_m=np.where(seen, depth_m, np.nan),
        pictures={"intensity": intensity},
    )


LIDAR = register_sensor(
    Sensor("lidar", "a scanning lidar", capture, pictures=("intensity",), options=LidarOptions)
)
