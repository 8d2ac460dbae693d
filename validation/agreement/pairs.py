"""Pairs of rocks in the right order: Kendall's τ_b and the share of pairs in order.

A pair is kept as two signs, that of the expected and that of the measured difference, with the
two rocks it came from. Statistics of pooled pairs can then be weighted by rock, which is what a
bootstrap over rocks (not over pairs, which are not independent) needs.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.agreement.block import Block


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

    def weights(self, rock_weights: NDArray[np.float64] | None) -> NDArray[np.float64]:
        """Return one weight a pair: the product of its rocks' weights, 1 without weights."""
        if rock_weights is None:
            return np.ones(self.first.size)
        return rock_weights[self.first] * rock_weights[self.second]


def _signs(differences: NDArray[np.float64], margin: float) -> NDArray[np.int8]:
    return (np.sign(differences) * (np.abs(differences) > margin)).astype(np.int8)


_Part = tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.float64], NDArray[np.float64]]


def _pool(parts: Iterator[_Part], *, rocks: int, truth_margin: float, value_margin: float) -> Pairs:
    columns = list(zip(*parts, strict=True))
    if not columns:
        no_index, no_sign = np.empty(0, np.intp), np.empty(0, np.int8)
        return Pairs(no_index, no_index, no_sign, no_sign, rocks)
    first, second, expected, found = (np.concatenate(column) for column in columns)
    measured = np.isfinite(found) & np.isfinite(expected)
    return Pairs(
        first=first[measured].astype(np.intp),
        second=second[measured].astype(np.intp),
        expected=_signs(expected[measured], truth_margin),
        found=_signs(found[measured], value_margin),
        rocks=rocks,
    )


def _offsets(blocks: Sequence[Block]) -> list[int]:
    return [0, *np.cumsum([block.rocks for block in blocks]).tolist()]


def within_views(
    blocks: Sequence[Block], *, truth_margin: float = 0.0, value_margin: float = 0.0
) -> Pairs:
    """Return all pairs of rocks of one scene seen in one view, against the true order.

    A true difference of at most `truth_margin` expects no order, and a measured one of at most
    `value_margin` is a tie. Pairs with an unmeasured rock are left out.
    """

    def parts() -> Iterator[_Part]:
        for block, offset in zip(blocks, _offsets(blocks), strict=False):
            i, j = np.triu_indices(block.rocks, 1)
            for values, truth in zip(block.values, block.view_truth, strict=True):
                yield offset + i, offset + j, truth[i] - truth[j], values[i] - values[j]

    return _pool(
        parts(),
        rocks=_offsets(blocks)[-1],
        truth_margin=truth_margin,
        value_margin=value_margin,
    )


def across_views(
    blocks: Sequence[Block], *, truth_margin: float = 0.0, value_margin: float = 0.0
) -> Pairs:
    """Return all pairs (rock i in view k, rock j in view l) of a scene, k = l included.

    With n rocks and m views these are m² n (n − 1)/2 pairs: 48 for the paper's tables 1 and 2,
    27 for table 3. Margins as in `within_views`.
    """

    def parts() -> Iterator[_Part]:
        for block, offset in zip(blocks, _offsets(blocks), strict=False):
            i, j = np.triu_indices(block.rocks, 1)
            shown = list(zip(block.values, block.view_truth, strict=True))
            for one, here in shown:
                for other, there in shown:
                    yield offset + i, offset + j, here[i] - there[j], one[i] - other[j]

    return _pool(
        parts(),
        rocks=_offsets(blocks)[-1],
        truth_margin=truth_margin,
        value_margin=value_margin,
    )


def between_views(blocks: Sequence[Block]) -> Pairs:
    """Return the pairs of rocks whose order in one view is held against that in another.

    No truth enters: τ_b of these pairs says whether the views agree with each other.
    """

    def parts() -> Iterator[_Part]:
        for block, offset in zip(blocks, _offsets(blocks), strict=False):
            i, j = np.triu_indices(block.rocks, 1)
            for k, one in enumerate(block.values):
                for other in block.values[k + 1 :]:
                    yield offset + i, offset + j, one[i] - one[j], other[i] - other[j]

    return _pool(parts(), rocks=_offsets(blocks)[-1], truth_margin=0.0, value_margin=0.0)


def tau_b(pairs: Pairs, rock_weights: NDArray[np.float64] | None = None) -> float:
    """Return Kendall's τ_b of pooled pairs.

    τ_b = Σ w e f / √(Σ w e² · Σ w f²) with e and f the expected and the found sign (Kendall 1945,
    "The treatment of ties in ranking problems"). For one block of one view it is the usual τ_b;
    for several, concordant and discordant pairs are pooled, never the coefficients averaged.
    NaN when either side has no order at all.
    """
    weights = pairs.weights(rock_weights)
    expected, found = pairs.expected.astype(np.float64), pairs.found.astype(np.float64)
    scale = np.sqrt((weights @ expected**2) * (weights @ found**2))
    return float(weights @ (expected * found) / scale) if scale > 0 else float("nan")


def share_in_order(pairs: Pairs, rock_weights: NDArray[np.float64] | None = None) -> float:
    """Return the share of pairs in the right order; a measured tie counts one half.

    Pairs without an expected order are left out; NaN when none is left.
    """
    weights = pairs.weights(rock_weights) * (pairs.expected != 0)
    credit = 0.5 * (1.0 + pairs.expected.astype(np.float64) * pairs.found)
    total = weights.sum()
    return float(weights @ credit / total) if total > 0 else float("nan")
