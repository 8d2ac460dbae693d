"""Range noise estimated from second differences of the ground's inverse depth along image rows.

A plane's inverse depth is linear along a row of a pinhole image and has no second difference, a
smooth undulation hardly any. Over a lag at which errors are no longer correlated what is left is
three independent errors.
"""

import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Floats
from rockshape.numerics.robust_scale import MEDIAN_TO_SIGMA

ROWS = 96  # of the frame, evenly: enough for 1 % of the standard deviation
MAX_WINDOW_PX = 11
PASSES = 3  # of window and variance, each from the other
CLEAR_PX = 2  # of the lag over the window that was found
INLIER = 4.0  # standard deviations from the plane beyond which a pixel is a rock or an outlier
BINS = 6
MIN_IN_BIN = 100
CUT = 3.0  # standard deviations within which values count,
CUT_VARIANCE = 0.9733  # and the variance of the standard normal distribution within them
ROUNDS = 20
UNCORRELATED = 0.05
SEPARABLE = 4.0  # ratio of 1/x² from which roughness can be told from range noise


def estimate_range_noise(residual_per_m: Floats, lever_m2: Floats) -> tuple[float, int]:
    """Standard deviation of 1/Z, and side in pixels of the window over which errors correlate.

    residual_per_m (rows, cols) is 1/Z less that of the plane along the same ray, NaN where unknown,
    positive on rocks; lever_m2 (rows, cols) turns it into a height. Rows need not be neighbours,
    columns must be. In six bins of the lever x the variance of the second differences is
    6 (k² + rough²/x²), for the error k of 1/Z and a roughness of the ground that is the same at all
    distances; both are fitted by non-negative least squares. Each variance is that of the values
    within three standard deviations, corrected for the tails; a median would jump with the steps of
    a disparity.

    (0, 1) where fewer than 100 second differences are known: the range is then taken to be exact.
    """
    error = _near_plane(residual_per_m)
    by_lag = _variances_by_lag(error)
    variance, window_px = by_lag[-1] / 6, 1
    for _ in range(PASSES):
        if variance == 0:
            return 0.0, 1
        window_px = _window(by_lag / variance)
        variance = _range_variance(error, lever_m2, lag=window_px + CLEAR_PX)
    return float(np.sqrt(variance)), window_px


def _range_variance(error: Floats, lever_m2: Floats, *, lag: int) -> float:
    """Variance of 1/Z by range noise from second differences; 0 where too few are known.

    A bin without scatter has neither noise nor roughness, and range is exact.
    """
    second = _second_differences(error, lag)
    lever = np.broadcast_to(lever_m2, error.shape)[:, lag:-lag][np.isfinite(second)]
    second = second[np.isfinite(second)]
    bins = [own for own in _bins(lever) if len(own) >= MIN_IN_BIN]
    if not bins:
        return 0.0
    variance = np.array([_clipped_variance(second[own]) / 6 for own in bins])
    if variance.min() == 0:
        return 0.0
    steepness = np.array([np.mean(lever[own] ** -2) for own in bins])
    return _offset(steepness, variance)


def estimate_roughness(height_m: Floats, lever_m2: Floats, *, range_sd_per_m: float) -> float:
    """Standard deviation of the ground's heights about its surface that range noise leaves over.

    height_m (n,) are heights over the surface and lever_m2 (n,) = |dh/d(1/Z)|. Only points below
    the surface count, since points above it may be rocks: their scatter in six bins of the lever,
    less the range noise's variance. The bins' relative errors are alike and weigh alike.
    """
    below = height_m < 0
    deep, lever = -height_m[below], lever_m2[below]
    excess, weight = [], []
    for own in _bins(lever):
        variance = (MEDIAN_TO_SIGMA * float(np.median(deep[own]))) ** 2
        excess.append(variance - range_sd_per_m**2 * float(np.mean(lever[own] ** 2)))
        weight.append(1 / max(variance, 1e-18) ** 2)
    return float(np.sqrt(max(np.average(excess, weights=weight), 0.0))) if excess else 0.0


def _near_plane(residual_per_m: Floats) -> Floats:
    """Residuals without those of rocks and outliers, by the scatter of those below the plane."""
    below = residual_per_m[residual_per_m < 0]
    if len(below) == 0:
        return np.full_like(residual_per_m, np.nan)
    limit = INLIER * MEDIAN_TO_SIGMA * float(np.median(-below))
    return np.where(np.abs(residual_per_m) <= limit, residual_per_m, np.nan)


def _second_differences(error: Floats, lag: int) -> Floats:
    """e(x + lag) - 2 e(x) + e(x - lag), (rows, cols - 2 lag)."""
    return error[:, 2 * lag :] - 2 * error[:, lag:-lag] + error[:, : -2 * lag]


def _variances_by_lag(error: Floats) -> Floats:
    """Variances of second differences over the lags 0 to 12, clipped by the last's deviation."""
    found = np.zeros(MAX_WINDOW_PX + 2)
    found[-1] = _clipped_variance(_second_differences(error, MAX_WINDOW_PX + 1))
    for lag in range(1, MAX_WINDOW_PX + 1):
        square = _second_differences(error, lag) ** 2
        kept = square[square <= CUT**2 * found[-1]]
        found[lag] = float(np.mean(kept)) / CUT_VARIANCE if len(kept) else found[-1]
    return found


def _window(ratio_by_lag: Floats) -> int:
    """Side of the correlation window, odd: the integral of the autocorrelation r along the rows.

    ratio_by_lag are variances of second differences over that of the errors, which at a lag l is
    6 - 8 r(l) + 2 r(2 l).
    """
    correlation = np.zeros(2 * MAX_WINDOW_PX + 1)
    for lag in range(MAX_WINDOW_PX, 0, -1):
        correlation[lag] = (6 + 2 * correlation[2 * lag] - ratio_by_lag[lag]) / 8
    end = int(np.argmax(correlation[1:] < UNCORRELATED))
    side = 1 + 2 * float(correlation[1 : end + 1].sum())
    return min(2 * round((side - 1) / 2) + 1, MAX_WINDOW_PX)


def _bins(lever_m2: Floats) -> list[NDArray[np.intp]]:
    """Indices into levers (n,) of the points of six bins of about equal size, none empty."""
    if len(lever_m2) == 0:
        return []
    edges = np.quantile(lever_m2, np.linspace(0, 1, BINS + 1)[1:-1])
    place = np.searchsorted(edges, lever_m2, side="right")
    return [own for own in (np.flatnonzero(place == one) for one in range(BINS)) if len(own)]


def _clipped_variance(values: Floats) -> float:
    """Variance of normal values of mean 0 among outliers, NaN where unknown; 0 of too few."""
    square = values[np.isfinite(values)] ** 2
    if len(square) < MIN_IN_BIN:
        return 0.0
    variance = MEDIAN_TO_SIGMA**2 * float(np.median(square))
    if variance == 0:  # most values are equal
        variance = float(np.mean(square))
    for _ in range(ROUNDS):
        kept = square[square <= CUT**2 * variance]
        before, variance = variance, float(np.mean(kept)) / CUT_VARIANCE
        if abs(variance - before) <= 1e-3 * before:
            break
    return variance


def _offset(x: Floats, y: Floats) -> float:
    """Value at x = 0 of the line through points (n,) of y > 0, neither falling nor below 0 there.

    Least squares of relative errors. Where x hardly varies the line is level.
    """
    least = float(y.min())
    weight = least / y
    rows = np.column_stack([weight, x * weight])
    offset, slope = np.linalg.lstsq(rows, y * weight, rcond=None)[0]
    if slope < 0 or x.max() < SEPARABLE * x.min():
        return least * float(weight.sum() / (weight**2).sum())
    return max(float(offset), 0.0)
