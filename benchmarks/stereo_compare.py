"""What a stereo error model and a matcher found in the same views, compared."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.sensor.rig import Rig
from synth.spec.sensor import NoiseSpec, SensorSpec

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

GREYS = (0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 255.0)  # of texture
MIN_PIXELS = 2000
LAGS = 17

_FIRST_ORDER = 0.05  # the most that σ_Z over Z may be
_GROSS_PX, _OFF_PX = 3.0, 1.0
_STEP_PX = 2.0  # more disparity than this within the window is an edge
_EVERY = 4  # row (or column) for the autocorrelation
_BINS = 6  # of range for each preset


@dataclass(frozen=True)
class Quality:
    """Pictures of a kind, and the model's numbers that belong to them."""

    name: str
    sensor: SensorSpec
    model: NoiseSpec


@dataclass(frozen=True, eq=False)
class Pair:
    """What both found in one view, (rows, cols) each: disparity, NaN in holes."""

    true_px: Floats
    model_px: Floats
    matcher_px: Floats
    texture: Floats  # grey levels

    def both(self) -> tuple[Floats, Floats]:
        """Return the errors of model and matcher."""
        return self.model_px - self.true_px, self.matcher_px - self.true_px

    def edge(self) -> Mask:
        """Tell where a step of disparity is within a window."""
        side = 2 * (NoiseSpec().window_px // 2) + 3
        box = np.ones((side, side), dtype=np.uint8)
        known_px = np.nan_to_num(self.true_px).astype(np.float32)
        return np.asarray(cv2.dilate(known_px, box) - cv2.erode(known_px, box) > _STEP_PX)


@dataclass(frozen=True)
class Row:
    """Errors of depth in one range of one preset: model, matcher."""

    range_m: float
    pixels: int
    rms_m: tuple[float, float]
    median_m: tuple[float, float]  # of the error's size


@dataclass(frozen=True, eq=False)
class Group:
    """One preset at one quality: model, matcher."""

    preset: str
    quality: Quality
    rows: tuple[Row, ...]
    holes: tuple[float, float]  # shares of the pixels that have a true depth
    common: float  # holes of both
    off: tuple[float, float]  # shares off by more than a pixel near edges, of those found
    off_else: tuple[float, float]  # and elsewhere
    along: tuple[Floats, Floats]  # autocorrelation of disparity errors along rows, (LAGS,)
    down: tuple[Floats, Floats]  # and along columns
    by_texture: Floats  # (len(GREYS) − 1, 3): pixels, sums of both squared errors of disparity
    seconds: tuple[float, float]  # of the processor, for a view


def compared(
    preset: str, quality: Quality, rig: Rig, pairs: Sequence[Pair], seconds: tuple[float, float]
) -> Group:
    """Return the comparison of some views."""
    true_px = _flat([pair.true_px for pair in pairs])
    errors = [_flat([pair.both()[side] for pair in pairs]) for side in (0, 1)]
    edge = _flat([pair.edge() for pair in pairs]) & ~np.isnan(true_px)
    rest = ~edge & ~np.isnan(true_px)
    holes = [np.isnan(error)[edge | rest] for error in errors]
    quiet = [
        tuple(np.where(pair.edge() | _gross(error), np.nan, error) for error in pair.both())
        for pair in pairs
    ]
    level = np.digitize(_flat([pair.texture for pair in pairs]), GREYS) - 1
    squares = [_flat([one[side] for one in quiet]) ** 2 for side in (0, 1)]
    known = ~np.isnan(squares[0] + squares[1]) & (level >= 0)
    return Group(
        preset=preset,
        quality=quality,
        rows=tuple(_rows(rig, true_px, errors)),
        holes=(float(holes[0].mean()), float(holes[1].mean())),
        common=float((holes[0] & holes[1]).mean()),
        off=(_off(errors[0][edge]), _off(errors[1][edge])),
        off_else=(_off(errors[0][rest]), _off(errors[1][rest])),
        along=(_likeness([one[0] for one in quiet]), _likeness([one[1] for one in quiet])),
        down=(_likeness([one[0].T for one in quiet]), _likeness([one[1].T for one in quiet])),
        by_texture=np.column_stack(
            [
                np.bincount(level[known], weights, minlength=len(GREYS) - 1)
                for weights in (np.ones(known.sum()), squares[0][known], squares[1][known])
            ]
        ),
        seconds=seconds,
    )


def _rows(rig: Rig, true_px: Floats, errors: Sequence[Floats]) -> Iterator[Row]:
    """Yield the errors of depth by range, of the pixels where both found one."""
    known = np.flatnonzero(~np.isnan(errors[0] + errors[1]) & ~_gross(errors[1]))
    true_m = rig.depth_m(true_px[known])
    found_m = [rig.depth_m(true_px[known] + error[known]) for error in errors]
    edges_m = np.geomspace(*np.percentile(true_m, [0.5, 99.5]), _BINS + 1)
    for low_m, high_m in pairwise(edges_m):
        here = (true_m >= low_m) & (true_m < high_m)
        if here.sum() < MIN_PIXELS:
            continue
        slips_m = [found[here] - true_m[here] for found in found_m]
        if _rms(slips_m[0]) > _FIRST_ORDER * true_m[here].mean():
            continue
        yield Row(
            range_m=float(true_m[here].mean()),
            pixels=int(here.sum()),
            rms_m=(_rms(slips_m[0]), _rms(slips_m[1])),
            median_m=(_median(slips_m[0]), _median(slips_m[1])),
        )


def _likeness(errors_px: Sequence[Floats]) -> Floats:
    """Return the autocorrelation of errors along every fourth row, (LAGS,), from lag 0 on."""
    sums, counts = np.zeros(LAGS), np.zeros(LAGS)
    for error in (whole[::_EVERY] for whole in errors_px):
        for lag in range(LAGS):
            products = error[:, lag:] * error[:, : error.shape[1] - lag]
            sums[lag] += np.nansum(products)
            counts[lag] += np.count_nonzero(~np.isnan(products))
    means = sums / counts
    return np.asarray(means / means[0])


def half_px(likeness: Floats) -> float:
    """Return the lag at which the autocorrelation falls to a half, infinite beyond the last."""
    below = np.flatnonzero(likeness < 0.5)
    if not len(below):
        return np.inf
    after = int(below[0])
    high, low = likeness[after - 1], likeness[after]
    return float(after - 1 + (high - 0.5) / (high - low))


def _gross(error_px: Floats) -> Mask:
    return np.asarray(np.abs(error_px) > _GROSS_PX)


def _off(error_px: Floats) -> float:
    known = error_px[~np.isnan(error_px)]
    return float((np.abs(known) > _OFF_PX).mean()) if len(known) else 0.0


def _flat(parts: Sequence[NDArray[Any]]) -> NDArray[Any]:
    return np.concatenate([part.ravel() for part in parts])


def _rms(values: Floats) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _median(values: Floats) -> float:
    return float(np.median(np.abs(values)))
