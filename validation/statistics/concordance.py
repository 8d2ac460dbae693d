"""Kendall's coefficient of concordance W: whether the views rank the rocks alike."""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from validation.arrays import Floats
from validation.statistics.block import Block
from validation.statistics.interval import of_sample
from validation.statistics.weighted import ratio

MAX_ARRANGEMENTS = 100_000
PERMUTATIONS = 1999
_PERMUTATION_SEED = 1939
_ROUNDING = 1e-9  # of sums of squared half ranks


@dataclass(frozen=True, eq=False)
class _Scenes:
    """The complete rocks of the blocks that have equally many views and such rocks."""

    ranks: Floats  # (blocks, views, rocks), less their view's mean
    signs: Floats  # (blocks, views, rocks, rocks): sign of value i − value j
    rock: NDArray[np.intp]  # (blocks, rocks) numbers among the rocks of all blocks


def _stack(blocks: Sequence[Block]) -> tuple[_Scenes, ...]:
    parts: dict[tuple[int, int], list[tuple[Floats, NDArray[np.intp]]]] = {}
    offset = 0
    for block in blocks:
        complete = np.flatnonzero(np.isfinite(block.values).all(axis=0))
        values = block.values[:, complete]
        if min(values.shape) >= 2:
            parts.setdefault(values.shape, []).append((values, complete + offset))
        offset += block.rocks
    stacks = []
    for alike in parts.values():
        values = np.stack([part for part, _ in alike])
        ranks = stats.rankdata(values, axis=2)
        stacks.append(
            _Scenes(
                ranks=ranks - ranks.mean(axis=2, keepdims=True),
                signs=np.sign(values[..., :, None] - values[..., None, :]),
                rock=np.stack([rock for _, rock in alike]),
            )
        )
    return tuple(stacks)


@dataclass(frozen=True, eq=False)
class Concordance:
    """Kendall's W of blocks, ready to be weighted by rock or tested."""

    stacks: tuple[_Scenes, ...]
    rocks: int  # of all blocks, complete or not

    @property
    def w(self) -> float:
        """W; NaN where no block has two views and two complete rocks, or every view ties all."""
        return of_sample(self.weighted, self.rocks)

    def weighted(self, weights: Floats) -> Floats:
        """W in each draw, (draws,), of one weight a rock, (draws, rocks): how often it was taken.

        A copy of a rock ties with it in every view, which the correction for ties takes out.
        """
        shared, total = np.zeros(len(weights)), np.zeros(len(weights))
        for scenes in self.stacks:
            own = np.moveaxis(weights[:, scenes.rock], 0, -1)[:, None]  # (blocks, 1, rocks, draws)
            ranks = 0.5 * (scenes.signs @ own)  # (blocks, views, rocks, draws)
            shared += (own[:, 0] * ranks.sum(axis=1) ** 2).sum(axis=(0, 1))
            total += ranks.shape[1] * (own * ranks**2).sum(axis=(0, 1, 2))
        return ratio(shared, total)

    def p_value(self) -> float:
        """Chance of such a W or a greater one if every view ranked at random.

        Exact, over all arrangements of the ranks of all views but the first, up to
        MAX_ARRANGEMENTS of them; beyond, (k + 1)/(N + 1) of N random ones (Phipson and Smyth
        2010). NaN where W is.
        """
        if math.isnan(self.w):
            return math.nan
        count = math.prod(
            math.factorial(scenes.ranks.shape[2])
            ** (len(scenes.ranks) * (scenes.ranks.shape[1] - 1))
            for scenes in self.stacks
        )
        found = sum(float(_shared(scenes.ranks).sum()) for scenes in self.stacks)
        if count <= MAX_ARRANGEMENTS:
            each = [_every(ranks) for scenes in self.stacks for ranks in scenes.ranks]
            sums = np.array([sum(chosen) for chosen in itertools.product(*each)])
            return float(np.mean(sums >= found - _ROUNDING))
        rng = np.random.default_rng(_PERMUTATION_SEED)
        sums = np.array([self._dealt(rng) for _ in range(PERMUTATIONS)])
        return float((np.count_nonzero(sums >= found - _ROUNDING) + 1) / (PERMUTATIONS + 1))

    def _dealt(self, rng: np.random.Generator) -> float:
        return sum(
            float(_shared(rng.permuted(scenes.ranks, axis=2)).sum()) for scenes in self.stacks
        )


def _shared(ranks: Floats) -> Floats:
    """Squared deviations of the rank sums of (…, views, rocks)."""
    shared: Floats = (ranks.sum(axis=-2) ** 2).sum(axis=-1)
    return shared


def _every(ranks: Floats) -> list[float]:
    """Squared deviations of the rank sums of every arrangement of (views, rocks)."""
    first, *others = ranks
    return [
        float(_shared(np.vstack([first, *dealt])))
        for dealt in itertools.product(*(itertools.permutations(view) for view in others))
    ]


def concordance(blocks: Sequence[Block]) -> Concordance:
    """Kendall's W with the correction for ties.

    W = 12 S / (m² (n³ − n) − m Σ T), with m views, n rocks, S the squared deviations of the rank
    sums and T = Σ (t³ − t) over the ties of a view (Kendall and Babington Smith 1939). The
    denominator is 12 m times the squared deviations of all ranks, and is computed so. For several
    blocks numerators and denominators are summed. Only rocks measured in every view count.
    """
    return Concordance(_stack(blocks), sum(block.rocks for block in blocks))


def kendall_w(blocks: Sequence[Block]) -> float:
    """W alone, as `concordance` defines it."""
    return concordance(blocks).w
