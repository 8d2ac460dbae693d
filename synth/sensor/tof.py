"""Time of flight: range from the phase of modulated light, with mixed pixels at depth edges."""

from typing import Annotated

import cv2
import numpy as np
from msgspec import Meta, Struct

from synth.arrays import Floats
from synth.sensor.echo import Echo, echo_of, ray_lengths
from synth.sensor.sensor import Capture, Sensor, SensorInput

_LIGHT_M_S = 299_792_458.0


class TofOptions(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Time-of-flight camera. A signal of 1 is that of a white, facing surface at 1 m."""

    footprint_px: Annotated[float, Meta(ge=1, le=31)] = 2.0  # side of the square a pixel sees
    sd_m: Annotated[float, Meta(ge=0, le=1)] = 0.001  # noise at a signal of 1, along the ray
    step_m: Annotated[float, Meta(ge=0, le=1)] = 0.001  # of the range that is told; 0: none
    saturation: Annotated[float, Meta(gt=0)] = 1.0  # signal above which a pixel tells nothing
    min_signal: Annotated[float, Meta(ge=0)] = 0.001  # and below which it tells nothing
    modulation_mhz: Annotated[float, Meta(gt=0, le=1000)] = 10.0  # range repeats every c/(2f)
    scatter: Annotated[float, Meta(ge=0, le=1)] = 0.0  # share of light that strays in the lens
    scatter_px: Annotated[float, Meta(gt=0, le=1000)] = 30.0  # standard deviation of its reach


def unambiguous_m(options: TofOptions) -> float:
    """Range at which the phase has come round once: c/(2f)."""
    return _LIGHT_M_S / (2e6 * options.modulation_mhz)


def tof_range_m(echo: Echo, options: TofOptions, *, rng: np.random.Generator) -> Floats:
    """Range along the rays, (rows, cols), that a time-of-flight camera tells; NaN in holes.

    A pixel sums the phasors s exp(4πi f r/c) over its footprint, so that at a depth edge its range
    lies between two surfaces (a flying pixel), each counted by its signal. Light that strays in
    the lens adds a share of the phasors round about: the bias of many paths. The noise is
    σ/√s, of shot noise; range is told modulo c/(2f), in steps. A pixel is a hole where its
    signal saturates or is lost.
    """
    whole_m = unambiguous_m(options)
    turn = 2.0 * np.pi / whole_m
    known_m = np.nan_to_num(echo.range_m)
    kernel = _box(options.footprint_px)
    parts = []
    for wave in (np.cos(turn * known_m), np.sin(turn * known_m)):
        part = echo.signal * wave
        mixed = cv2.sepFilter2D(part, cv2.CV_64F, kernel, kernel, borderType=cv2.BORDER_REPLICATE)
        if options.scatter > 0.0:
            stray = cv2.GaussianBlur(part, (0, 0), options.scatter_px)
            mixed = (1.0 - options.scatter) * mixed + options.scatter * stray
        parts.append(mixed)
    signal = np.hypot(*parts)
    range_m = np.arctan2(parts[1], parts[0]) / turn
    range_m += options.sd_m / np.sqrt(np.maximum(signal, 1e-12)) * rng.standard_normal(signal.shape)
    range_m %= whole_m
    if options.step_m > 0.0:
        range_m = options.step_m * np.rint(range_m / options.step_m)
    told = (signal <= options.saturation) & (signal >= options.min_signal) & (range_m > 0.0)
    return np.where(told, range_m, np.nan)


def _box(width_px: float) -> Floats:
    """Weights (n,) of whole pixels in a footprint that is so wide and lies about the middle one."""
    reach = int(np.ceil((width_px - 1.0) / 2.0))
    offsets = np.abs(np.arange(-reach, reach + 1))
    return np.asarray(np.clip(width_px / 2.0 - offsets + 0.5, 0.0, 1.0) / width_px)


def _capture(shot: SensorInput) -> Capture:
    range_m = tof_range_m(echo_of(shot), shot.options, rng=shot.random("tof"))
    return Capture(picture=shot.picture, depth_m=range_m / ray_lengths(shot.camera))


TOF = Sensor(
    "tof",
    "time of flight, with flying pixels, saturation and steps",
    _capture,
    options=TofOptions,
)
