"""How much of the difference between views is true: what each view's own outline explains."""

import numpy as np
from numpy.typing import NDArray

from validation.arrays import Floats
from validation.kinds.design.judge.variance_components import MIN_VIEWS, whole_views
from validation.statistics.weighted import ratio


def _deviations(clean: Floats, outlines: Floats, whole: NDArray[np.bool_]) -> Floats | None:
    """Each whole view's mean value over the rock's, less 1, and its outline's deviations.

    clean is (views, distances, rolls), outlines (views, truths); the result is (whole views,
    1 + truths), every column of mean 0. None with too few views, or without a true outline.
    """
    values, truths = clean[whole].mean(axis=(1, 2)), outlines[whole]
    if whole.sum() < MIN_VIEWS or not np.isfinite(truths).all() or values.mean() == 0:
        return None
    return np.column_stack([values / values.mean() - 1.0, truths - truths.mean(axis=0)])


def explained_share(moments: Floats) -> Floats:
    """Share R² of the values' variance that a line in the outlines' truths explains.

    moments (draws, 1 + truths, 1 + truths) are summed products of deviations, y first:
    R² = s_yx S_xx⁺ s_xy/s_yy, with one line for all rocks; (draws,).
    """
    across = moments[:, 0, 1:, None]
    slopes = np.linalg.pinv(moments[:, 1:, 1:]) @ across
    return ratio((across * slopes).sum(axis=(1, 2)), moments[:, 0, 0])


def moments_of(clean: Floats, found: Floats, noisy: Floats, outlines: Floats) -> Floats:
    """Rock's mean products of deviations, (1 + truths, 1 + truths); NaN without."""
    own = _deviations(clean, outlines, whole_views(clean, found, noisy))
    if own is None:
        return np.full(2 * (1 + outlines.shape[-1],), np.nan)
    return np.asarray(own.T @ own / len(own))
