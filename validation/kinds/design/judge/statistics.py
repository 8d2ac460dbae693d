"""Statistics of a designed experiment's cells, each with an interval over rocks."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from validation.arrays import Floats
from validation.kinds.design.judge.outlines import explained_share, moments_of
from validation.kinds.design.judge.shared_variance import movements
from validation.kinds.design.judge.tensors import Cubes
from validation.kinds.design.judge.variance_components import CAUSES, MIN_VIEWS, split
from validation.kinds.design.spec import CLEAN, FOUND, NOISY
from validation.scores.score import Estimate
from validation.statistics import Block, Pairs
from validation.statistics.interval import Weighted, of_sample
from validation.statistics.weighted import ratio

Compute = Callable[[Cubes], Estimate]


def parts_of(cubes: Cubes) -> Floats:
    """Each rock's parts in the order of CAUSES, then their total, (rocks, 7); NaN: none."""
    table = np.full((len(cubes.clean), len(CAUSES) + 1), np.nan)
    for rock, cells in enumerate(zip(cubes.clean, cubes.found, cubes.noisy, strict=True)):
        parts = split(*cells)
        if parts is not None:
            table[rock] = [*(getattr(parts, cause) for cause in CAUSES), parts.total]
    return table


def _pooled(table: Floats, value: Weighted) -> Estimate:
    """Statistic of the mean row of (rocks, …), which NaN rocks do not enter.

    `value` takes the mean rows of draws, (draws, …).
    """
    flat = table.reshape(len(table), -1)
    known = np.asarray(np.isfinite(flat).all(axis=1))
    if not known.any():
        return Estimate(float("nan"), 0)
    rows = np.where(known[:, None], flat, 0.0)

    def weighted(weights: Floats) -> Floats:
        drawn = weights[:, known].sum(axis=1)
        found = np.full(len(weights), np.nan)
        means = (weights[drawn > 0] @ rows) / drawn[drawn > 0, None]
        found[drawn > 0] = value(means.reshape(-1, *table.shape[1:]))
        return found

    return Estimate(of_sample(weighted, len(table)), int(known.sum()), len(table), weighted)


def share_of(cause: str) -> Compute:
    """Share of a rock's variance by a cause, over the rocks' means."""
    index = CAUSES.index(cause)

    return lambda cubes: _pooled(
        parts_of(cubes), lambda means: ratio(means[:, index], means[:, -1])
    )


def cv(cubes: Cubes) -> Estimate:
    """Coefficient of variation of the values of all cells."""
    return _pooled(parts_of(cubes), lambda means: np.sqrt(means[:, -1]))


def cv_clean(cubes: Cubes) -> Estimate:
    """Coefficient of variation of the clean values alone, over the views with all of them."""
    table = np.full(len(cubes.clean), np.nan)
    for rock, clean in enumerate(cubes.clean):
        whole = np.isfinite(clean).all(axis=(1, 2))
        if whole.sum() >= MIN_VIEWS and clean[whole].mean() != 0.0:
            table[rock] = clean[whole].var() / clean[whole].mean() ** 2
    return _pooled(table, np.sqrt)


def true_share(cubes: Cubes) -> Estimate:
    """Share of the variance between views that the true outlines explain."""
    rocks = zip(cubes.clean, cubes.found, cubes.noisy, cubes.outlines, strict=True)
    return _pooled(np.stack([moments_of(*rock) for rock in rocks]), explained_share)


def shared_movement(state: str) -> Compute:
    """Share of their movement that the rocks of a frame have in common."""

    def compute(cubes: Cubes) -> Estimate:
        values = cubes.clean if state == CLEAN else cubes.noisy
        flat = values.reshape(len(values), -1)
        found = movements(flat, rocks_a_scene=cubes.rocks_a_scene)
        value = of_sample(found.shared, len(flat))
        return Estimate(value, len(found.first), len(flat), found.shared)

    return compute


def measured_share(state: str) -> Compute:
    """Share of the cells, of rocks seen whole, in which there is a value."""

    def compute(cubes: Cubes) -> Estimate:
        values = {CLEAN: cubes.clean, FOUND: cubes.found, NOISY: cubes.noisy}[state]
        seen = cubes.eligible if state == CLEAN else cubes.eligible[:, :, :, None, :]
        seen = np.broadcast_to(seen, values.shape).reshape(len(values), -1)
        good = np.isfinite(values).reshape(len(values), -1) & seen
        counts = np.column_stack([good.sum(axis=1), seen.sum(axis=1)]).astype(np.float64)
        found = _pooled(counts, lambda means: ratio(means[:, 0], means[:, 1]))
        return Estimate(found.value, int(seen.sum()), found.rocks, found.weighted)

    return compute


def _blocks(cubes: Cubes, state: str) -> tuple[Block, ...]:
    """Block (cells, rocks) for each scene, ranked by the rocks' clean means."""
    values = cubes.clean if state == CLEAN else cubes.noisy
    scenes = range(0, len(cubes.clean), cubes.rocks_a_scene)
    blocks = []
    for first in scenes:
        own = slice(first, first + cubes.rocks_a_scene)
        known = np.isfinite(cubes.clean[own])
        total = np.where(known, cubes.clean[own], 0.0).sum(axis=(1, 2, 3))
        count = known.sum(axis=(1, 2, 3))
        means = np.where(count > 0, total / np.maximum(count, 1), np.nan)
        cells = values[own].reshape(cubes.rocks_a_scene, -1).T
        blocks.append(Block(values=cells, truth=means))
    return tuple(blocks)


def order(
    state: str,
    pairs_of: Callable[[Sequence[Block]], Pairs],
    value: Callable[[Pairs, Floats], Floats],
) -> Compute:
    """Statistic of the pairs of rocks in the cells of a state."""

    def compute(cubes: Cubes) -> Estimate:
        pairs = pairs_of(_blocks(cubes, state))
        weighted = partial(value, pairs)
        return Estimate(of_sample(weighted, pairs.rocks), pairs.decided, pairs.rocks, weighted)

    return compute
