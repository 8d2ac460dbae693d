"""Spread of values within a rock, from view to view, beside that between rocks."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from validation.arrays import Floats
from validation.statistics.block import Block
from validation.statistics.weighted import mean, ratio, square_sum


class Spreads(NamedTuple):
    """Mean and sample variance of each rock over the views; NaN where fewer than two show it."""

    mean: Floats  # (rocks,)
    variance: Floats  # (rocks,)


def spreads_over_views(blocks: Sequence[Block]) -> Spreads:
    """Spreads of the rocks of all blocks, in the blocks' order."""
    parts = [np.empty((2, 0))]
    for block in blocks:
        shown = np.isfinite(block.values)
        views = shown.sum(axis=0)
        often = np.where(views > 1, views, np.nan)
        middle = np.where(shown, block.values, 0.0).sum(axis=0) / often
        off = np.where(shown, block.values - middle, 0.0)
        parts.append(np.stack([middle, (off**2).sum(axis=0) / (often - 1)]))
    return Spreads(*np.concatenate(parts, axis=1))


def weighted_within_over_between(spreads: Spreads, weights: Floats) -> Floats:
    """Standard deviation within a rock over that of the rocks' means, (draws,).

    The former is the root of the mean variance. `weights` is (draws, rocks). For values that have
    nothing to do with their rocks it is the root of the number of views.
    """
    kept = np.isfinite(spreads.mean)
    middle, variance, weights = spreads.mean[kept], spreads.variance[kept], weights[:, kept]
    between = ratio(square_sum(middle, weights), weights.sum(axis=1) - 1)
    return np.sqrt(ratio(mean(variance, weights), between))
