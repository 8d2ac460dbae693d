"""A line scanner: range along every n-th row, with noise, up to a greatest distance."""

import numpy as np
from msgspec import Struct

from synth.sensor import Capture, Sensor, SensorInput, register_sensor


class ScannerOptions(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The table [noise.options]."""

    rows_apart: int = 4
    sd_m: float = 0.01
    farthest_m: float = 20.0


def capture(shot: SensorInput) -> Capture:
    options: ScannerOptions = shot.options
    exact_m = shot.view.depth_m
    depth_m = exact_m + options.sd_m * shot.random("scanner").standard_normal(exact_m.shape)
    scanned = np.zeros(exact_m.shape, dtype=bool)
    scanned[:: options.rows_apart] = True
    seen = scanned & (exact_m <= options.farthest_m)
    intensity = np.where(seen, shot.view.image, 0).astype(np.uint8)
    return Capture(
        picture=shot.picture,
        depth_m=np.where(seen, depth_m, np.nan),
        pictures={"intensity": intensity},
    )


SCANNER = register_sensor(
    Sensor("scanner", "a line scanner", capture, pictures=("intensity",), options=ScannerOptions)
)
