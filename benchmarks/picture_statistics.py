"""Statistics of pictures that tell made ones from photographs, and descriptors of patches."""

from collections.abc import Iterable, Iterator

import cv2
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bytes = NDArray[np.uint8]

SIDE_PX = 64  # of a patch
STATISTICS = ("spectrum slope", "gradient kurtosis", "contrast", "shadow", "saturation")
_BANDS = np.array([1.5, 3, 5, 8, 12, 17, 23, 32])  # edges, cycles a patch
_SCALES = 3  # at which differences are taken, each half as fine as the last
_DARK = 0.5  # of the median brightness: what is darker is shadow
_TINY = 1e-9
_CONSTANT = 1e-12  # variance of brightness below which there is none


def patches(picture: Bytes) -> Iterator[Bytes]:
    """Yield the patches (side, side, 3) of a picture (rows, cols, 3), side by side."""
    rows, cols = (length // SIDE_PX for length in picture.shape[:2])
    for row in range(rows):
        for col in range(cols):
            part = np.s_[row * SIDE_PX : (row + 1) * SIDE_PX, col * SIDE_PX : (col + 1) * SIDE_PX]
            yield picture[part]


def statistics(patch: Bytes) -> Floats:
    """Values (5,) in the order of STATISTICS.

    Slope of the logarithm of radial power over that of frequency; Pearson's kurtosis of the
    differences between neighbours; standard deviation over mean; share darker than half the
    median; mean of (max − min)/max of red, green and blue, NaN for grey.
    """
    grey = brightness(patch)
    steps = np.concatenate([np.diff(grey, axis=0).ravel(), np.diff(grey, axis=1).ravel()])
    power, middle = _band_power(grey)
    high, low = patch.max(axis=-1).astype(float), patch.min(axis=-1).astype(float)
    coloured = (high - low).max() > 0
    return np.array(
        [
            np.polyfit(np.log(middle), np.log(power + _TINY), 1)[0],
            _kurtosis(steps),
            grey.std() / max(grey.mean(), _TINY),
            (grey < _DARK * np.median(grey)).mean(),
            ((high - low) / np.maximum(high, 1.0)).mean() if coloured else np.nan,
        ]
    )


def descriptors(found: Iterable[Bytes]) -> Floats:
    """Descriptors (patches, n) of patches."""
    return np.array([descriptor(patch) for patch in found])


def descriptor(patch: Bytes) -> Floats:
    """Descriptor (n,) of a patch's brightness alone: spectrum, moments and filters' responses."""
    grey = brightness(patch)
    power, _ = _band_power(grey)
    level = np.log(power + _TINY)
    part = (grey - grey.mean()) / max(grey.std(), 1e-3)
    values = [*(level - level.mean()), *np.percentile(part, [1, 10, 25, 50, 75, 90, 99])]
    values += [grey.mean(), np.log(grey.std() + 1e-3), _skew(grey), _kurtosis(grey)]
    values.append((grey < _DARK * np.median(grey)).mean())
    spreads = []
    for _ in range(_SCALES):
        across, down = np.diff(grey, axis=1), np.diff(grey, axis=0)
        bend = cv2.Laplacian(grey, cv2.CV_64F)
        size = np.hypot(across[:-1], down[:, :-1])
        mean = max(size.mean(), _TINY)
        values += [
            np.log(_kurtosis(np.concatenate([across.ravel(), down.ravel()]))),
            np.log(_kurtosis(bend)),
            _skew(bend),
            np.log((across.std() + 1e-3) / (down.std() + 1e-3)),
            np.log(size.std() / mean + 1e-3),
            _correlation(size[:, 1:], size[:, :-1]),
        ]
        spreads.append(np.log(size.mean() + 1e-4))
        grey = cv2.resize(grey, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
    return np.array([*values, *np.diff(spreads)])


def brightness(patch: Bytes) -> Floats:
    """Brightness (rows, cols), 1 for white."""
    return np.asarray(patch @ np.array([0.299, 0.587, 0.114]) / 255.0, dtype=np.float64)


def _band_power(grey: Floats) -> tuple[Floats, Floats]:
    """Mean power in bands of frequency (7,) of a windowed patch, and their middles."""
    window = np.hanning(len(grey))
    power = np.abs(np.fft.fft2((grey - grey.mean()) * window[:, None] * window)) ** 2
    frequency = np.fft.fftfreq(len(grey)) * len(grey)
    radius = np.hypot(frequency[:, None], frequency)
    band = np.digitize(radius, _BANDS) - 1
    inside = (band >= 0) & (band < len(_BANDS) - 1)
    total = np.bincount(band[inside], weights=power[inside])
    return total / np.bincount(band[inside]), np.sqrt(_BANDS[1:] * _BANDS[:-1])


def _kurtosis(values: Floats) -> float:
    """Return Pearson's kurtosis, 3 for a constant."""
    off = values - values.mean()
    square = off * off
    variance = float(square.mean())
    return 3.0 if variance < _CONSTANT else float((square * square).mean()) / variance**2


def _skew(values: Floats) -> float:
    """Return the skewness, 0 for a constant."""
    off = values - values.mean()
    square = off * off
    variance = float(square.mean())
    return 0.0 if variance < _CONSTANT else float((square * off).mean()) / variance**1.5


def _correlation(one: Floats, two: Floats) -> float:
    if min(one.std(), two.std()) < 1e-9:
        return 0.0
    return float(np.corrcoef(one.ravel(), two.ravel())[0, 1])
