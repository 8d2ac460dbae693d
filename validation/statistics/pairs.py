"""Pairs of rocks in the right order: Kendall's τ_b and the share of pairs in order.

A pair is kept as two signs, that of the expected and that of the measured difference, with the
two rocks it came from. Statistics of pooled pairs can then be weighted by rock, which is what a
bootstrap over rocks (not over pairs, which are not independent) needs.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from validation.arrays import Floats
from validation.statistics.block import Block
from validation.statistics.interval import of_sample
from validation.statistics.weighted import ratio


@dataclass(frozen=True, eq=False)
class Pairs:
    """Pooled pairs; `rocks` counts the rocks of all blocks, also those without a pair."""

    first: NDArray[np.intp]  # (pairs,) index of a rock among the rocks of all blocks
    second: NDArray[np.intp]  # (pairs,)
    expected: NDArray[np.int8]  # (pairs,) -1, 0 or 1: the order that ought to be
    found: NDArray[np.int8]  # (pairs,) -1, 0 or 1: the order that was measured
    rocks: int

    @property
    def decided(self) -> int:
        """The number of pairs for which an order is expected."""
        return int(np.count_nonzero(self.expected))

    @property
    def right(self) -> int:
        """The number of pairs found in the expected order."""
        return int(np.count_nonzero((self.expected != 0) & (self.expected == self.found)))

    @cached_property
    def tallies(self) -> "Tallies":
        """The pairs summed by their two rocks."""
        couples, couple = np.unique(self.first * self.rocks + self.second, return_inverse=True)

        def total(each: NDArray[np.int8]) -> NDArray[np.float64]:
            weights = each.astype(np.float64)
            return np.bincount(couple, weights=weights, minlength=couples.size).astype(np.float64)

        return Tallies(
            first=couples // max(1, self.rocks),
            second=couples % max(1, self.rocks),
            expected=total(self.expected**2),
            found=total(self.found**2),
            agreed=total(self.expected * self.found),
        )


@dataclass(frozen=True, eq=False)
class Tallies:
    """Sums over the pairs of each two rocks: all that a weighted statistic needs."""

    first: NDArray[np.intp]  # (couples,)
    second: NDArray[np.intp]  # (couples,)
    expected: NDArray[np.float64]  # (couples,) number of pairs with an expected order
    found: NDArray[np.float64]  # (couples,) number of pairs with a measured order
    agreed: NDArray[np.float64]  # (couples,) concordant less discordant pairs

    def sums(self, weights: Floats) -> tuple[Floats, Floats, Floats]:
        """Sums of expected, found and agreed, a pair weighing its rocks' product.

        `weights` is (draws, rocks), each sum (draws,).
        """
        both = weights[:, self.first] * weights[:, self.second]
        expected, found, agreed = (both @ np.stack([self.expected, self.found, self.agreed]).T).T
        return expected, found, agreed


def _signs(differences: NDArray[np.float64], margin: float) -> NDArray[np.int8]:
    return (np.sign(differences) * (np.abs(differences) > margin)).astype(np.int8)


_Index = NDArray[np.intp]
_Differences = tuple[NDArray[np.float64], NDArray[np.float64]]  # of each pair: expected, found
_OfBlock = Callable[[Block, _Index, _Index], Iterator[_Differences]]


def _pool(
    blocks: Sequence[Block], differences: _OfBlock, *, truth_margin: float, value_margin: float
) -> Pairs:
    """Pairs of all blocks, of each block's two rocks (i, j) as many as it has differences."""
    parts, rocks = [], 0
    for block in blocks:
        i, j = np.triu_indices(block.rocks, 1)
        parts += [(rocks + i, rocks + j, *each) for each in differences(block, i, j)]
        rocks += block.rocks
    if not parts:
        no_index, no_sign = np.empty(0, np.intp), np.empty(0, np.int8)
        return Pairs(no_index, no_index, no_sign, no_sign, rocks)
    first, second, expected, found = (np.concatenate(column) for column in zip(*parts, strict=True))
    measured = np.isfinite(found) & np.isfinite(expected)
    return Pairs(
        first=first[measured].astype(np.intp),
        second=second[measured].astype(np.intp),
        expected=_signs(expected[measured], truth_margin),
        found=_signs(found[measured], value_margin),
        rocks=rocks,
    )


def within_views(
    blocks: Sequence[Block], *, truth_margin: float = 0.0, value_margin: float = 0.0
) -> Pairs:
    """All pairs of rocks of one scene seen in one view, against the true order.

    A true difference of at most `truth_margin` expects no order, and a measured one of at most
    `value_margin` is a tie. Pairs with an unmeasured rock are left out.
    """

    def differences(block: Block, i: _Index, j: _Index) -> Iterator[_Differences]:
        for values, truth in zip(block.values, block.view_truth, strict=True):
            yield truth[i] - truth[j], values[i] - values[j]

    return _pool(blocks, differences, truth_margin=truth_margin, value_margin=value_margin)


def across_views(
    blocks: Sequence[Block], *, truth_margin: float = 0.0, value_margin: float = 0.0
) -> Pairs:
    """All pairs (rock i in view k, rock j in view l) of a scene, k = l included.

    With n rocks and m views these are m² n (n − 1)/2 pairs: 48 for the paper's tables 1 and 2,
    27 for table 3. Margins as in `within_views`.
    """

    def differences(block: Block, i: _Index, j: _Index) -> Iterator[_Differences]:
        shown = list(zip(block.values, block.view_truth, strict=True))
        for one, here in shown:
            for other, there in shown:
                yield here[i] - there[j], one[i] - other[j]

    return _pool(blocks, differences, truth_margin=truth_margin, value_margin=value_margin)


def between_views(blocks: Sequence[Block]) -> Pairs:
    """Pairs of rocks whose order in one view is held against that in another.

    No truth enters: τ_b of these pairs says whether the views agree with each other.
    """

    def differences(block: Block, i: _Index, j: _Index) -> Iterator[_Differences]:
        for k, one in enumerate(block.values):
            for other in block.values[k + 1 :]:
                yield one[i] - one[j], other[i] - other[j]

    return _pool(blocks, differences, truth_margin=0.0, value_margin=0.0)


def weighted_tau_b(pairs: Pairs, weights: Floats) -> Floats:
    """Kendall's τ_b of pooled pairs in each draw, (draws,), of weights (draws, rocks)."""
    expected, found, agreed = pairs.tallies.sums(weights)
    return ratio(agreed, np.sqrt(expected * found))


def weighted_share_in_order(pairs: Pairs, weights: Floats) -> Floats:
    """Share of pairs in the right order in each draw, (draws,), of weights (draws, rocks)."""
    expected, _, agreed = pairs.tallies.sums(weights)
    return 0.5 * (1.0 + ratio(agreed, expected))


def tau_b(pairs: Pairs) -> float:
    """Kendall's τ_b of pooled pairs.

    τ_b = Σ w e f / √(Σ w e² · Σ w f²) with e and f the expected and the found sign (Kendall 1945,
    "The treatment of ties in ranking problems"). For one block of one view it is the usual τ_b;
    for several, concordant and discordant pairs are pooled, never the coefficients averaged.
    NaN when either side has no order at all.
    """
    return of_sample(lambda weights: weighted_tau_b(pairs, weights), pairs.rocks)


def share_in_order(pairs: Pairs) -> float:
    """Share of pairs in the right order; a measured tie counts one half.

    Pairs without an expected order are left out; NaN when none is left.
    """
    return of_sample(lambda weights: weighted_share_in_order(pairs, weights), pairs.rocks)
