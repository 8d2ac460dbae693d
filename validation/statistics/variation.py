"""How far the value of one rock moves from view to view."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from validation.statistics.block import Block
from validation.statistics.spread import spreads_over_views


def divide_by_view_means(blocks: Sequence[Block]) -> tuple[Block, ...]:
    """Blocks whose values are divided by their view's mean over the complete rocks.

    It takes out what moves all rocks of a view together. Views whose mean is not positive become
    NaN.
    """
    divided = []
    for block in blocks:
        keep = np.isfinite(block.values).all(axis=0)
        means = np.full((block.values.shape[0], 1), np.nan)
        if keep.any():
            means = block.values[:, keep].mean(axis=1, keepdims=True)
        means = np.where(means > 0, means, np.nan)
        divided.append(Block(values=block.values / means, truth=block.truth))
    return tuple(divided)


def coefficients_of_variation(blocks: Sequence[Block]) -> NDArray[np.float64]:
    """One coefficient of variation across views for each rock of all blocks.

    CV = s/x̄ with s the sample standard deviation (n − 1) over the views that show the rock. Shape
    (rocks,), in the blocks' order; NaN for a rock that fewer than two views show, and where the
    mean is not positive.
    """
    spreads = spreads_over_views(blocks)
    return np.sqrt(spreads.variance) / np.where(spreads.mean > 0, spreads.mean, np.nan)


def rank_moves(blocks: Sequence[Block]) -> NDArray[np.float64]:
    """How far each rock's rank moves between two views, as a share of the ranking.

    All rock views of a block are ranked together, as in the paper's table 5; a rock's move is the
    mean difference of its ranks over the pairs of views that show it, over the number of rock
    views. Of independent ranks it is 1/3. Shape (rocks,), in the blocks' order; NaN for a rock that
    fewer than two views show.
    """
    moves: list[NDArray[np.float64]] = [np.empty(0)]
    for block in blocks:
        ranks = stats.rankdata(block.values, axis=None, nan_policy="omit")
        ranks = ranks.reshape(block.values.shape) / max(1, np.isfinite(block.values).sum())
        one, other = np.triu_indices(block.values.shape[0], 1)
        apart = np.abs(ranks[one] - ranks[other])
        counts = np.isfinite(apart).sum(axis=0)
        total = np.where(np.isfinite(apart), apart, 0.0).sum(axis=0)
        moves.append(np.where(counts > 0, total, np.nan) / np.maximum(counts, 1))
    return np.concatenate(moves)
