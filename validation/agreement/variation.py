"""How far the value of one rock moves from view to view."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from validation.agreement.block import Block


def divide_by_view_means(blocks: Sequence[Block]) -> tuple[Block, ...]:
    """Return blocks whose values are divided by their view's mean over the complete rocks.

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
    """Return one coefficient of variation across views for each rock of all blocks.

    CV = s/x̄ with s the sample standard deviation (n − 1). Shape (rocks,), in the blocks' order;
    NaN for a rock that some view lacks, for a single view, and where the mean is not positive.
    """
    cvs: list[NDArray[np.float64]] = [np.empty(0)]
    for block in blocks:
        cv = np.full(block.rocks, np.nan)
        mean = block.values.mean(axis=0)
        usable = np.isfinite(mean) & (mean > 0) & (block.values.shape[0] > 1)
        if usable.any():
            cv[usable] = block.values[:, usable].std(axis=0, ddof=1) / mean[usable]
        cvs.append(cv)
    return np.concatenate(cvs)
