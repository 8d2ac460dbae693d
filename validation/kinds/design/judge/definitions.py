"""Scores of a designed experiment: how far a rock's value moves, and what moves it."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
import pandas as pd

from rockshape.measures.measure import Measure
from rockshape.method import find_method
from validation.arrays import Floats
from validation.kinds.design.judge.outlines import explained_share, moments_of
from validation.kinds.design.judge.shared_variance import movements
from validation.kinds.design.judge.tensors import Cubes, cubes_of
from validation.kinds.design.judge.variance_components import CAUSES, MIN_VIEWS, split
from validation.kinds.design.spec import CLEAN, FOUND, NOISY, STATES, DesignExperiment
from validation.peers import MeasureSpec
from validation.scores.score import Better, Definition, Estimate, Key
from validation.scores.titles import REFERENCE
from validation.statistics import (
    Block,
    Pairs,
    across_views,
    between_views,
    weighted_share_in_order,
    weighted_tau_b,
    within_views,
)
from validation.statistics.interval import Weighted, of_sample
from validation.statistics.weighted import ratio

Compute = Callable[[Cubes], Estimate]

TITLES = {
    "view": "the view",
    "distance": "distance",
    "light": "light",
    "noise": "range noise",
    "segmentation": "segmentation",
    "rest": "the grid of pixels",
}


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


def _share(cause: str) -> Compute:
    index = CAUSES.index(cause)

    return lambda cubes: _pooled(
        parts_of(cubes), lambda means: ratio(means[:, index], means[:, -1])
    )


def _cv(cubes: Cubes) -> Estimate:
    return _pooled(parts_of(cubes), lambda means: np.sqrt(means[:, -1]))


def _cv_clean(cubes: Cubes) -> Estimate:
    """Coefficient of variation of the clean values alone, over the views with all of them."""
    table = np.full(len(cubes.clean), np.nan)
    for rock, clean in enumerate(cubes.clean):
        whole = np.isfinite(clean).all(axis=(1, 2))
        if whole.sum() >= MIN_VIEWS and clean[whole].mean() != 0.0:
            table[rock] = clean[whole].var() / clean[whole].mean() ** 2
    return _pooled(table, np.sqrt)


def _true_share(cubes: Cubes) -> Estimate:
    rocks = zip(cubes.clean, cubes.found, cubes.noisy, cubes.outlines, strict=True)
    return _pooled(np.stack([moments_of(*rock) for rock in rocks]), explained_share)


def _shared(state: str) -> Compute:
    def compute(cubes: Cubes) -> Estimate:
        values = cubes.clean if state == CLEAN else cubes.noisy
        flat = values.reshape(len(values), -1)
        found = movements(flat, rocks_a_scene=cubes.rocks_a_scene)
        value = of_sample(found.shared, len(flat))
        return Estimate(value, len(found.first), len(flat), found.shared)

    return compute


def _measured(state: str) -> Compute:
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


def _order(
    state: str,
    pairs_of: Callable[[Sequence[Block]], Pairs],
    value: Callable[[Pairs, Floats], Floats],
) -> Compute:
    def compute(cubes: Cubes) -> Estimate:
        pairs = pairs_of(_blocks(cubes, state))
        weighted = partial(value, pairs)
        return Estimate(of_sample(weighted, pairs.rocks), pairs.decided, pairs.rocks, weighted)

    return compute


_STATISTICS: tuple[tuple[str, str, str, str, Better, Compute], ...] = (
    ("cv", "how far a rock's value moves in all, relative (root of mean square)", "1", "rocks",
     "lower", _cv),
    ("cv_clean", "the same with true masks and exact range", "1", "rocks", "lower", _cv_clean),
    *(
        (f"share_{cause}", f"share of a rock's variance by {TITLES[cause]}", "share", "rocks",
         "neither", _share(cause))
        for cause in CAUSES
    ),
    *(
        (f"measured_{state}", f"cells with a value, {state}", "share", "cells", "higher",
         _measured(state))
        for state in STATES
    ),
    ("shared", "what all rocks of a frame share of their movement", "share", "pairs of rocks",
     "neither", _shared(NOISY)),
    ("shared_clean", "the same with true masks and exact range", "share", "pairs of rocks",
     "neither", _shared(CLEAN)),
    ("tau_frames", "agreement of two frames' rankings (mean pairwise τ_b)", "1", "pairs",
     "higher", _order(NOISY, between_views, weighted_tau_b)),
    ("tau_frames_clean", "the same with true masks and exact range", "1", "pairs", "higher",
     _order(CLEAN, between_views, weighted_tau_b)),
    ("order_within", "pairs of one frame in the order of the rocks' means", "share", "pairs",
     "higher", _order(NOISY, within_views, weighted_share_in_order)),
    ("order_across", "pairs of any two frames in the order of the rocks' means", "share", "pairs",
     "higher", _order(NOISY, across_views, weighted_share_in_order)),
)  # fmt: skip
_TRUE: tuple[str, str, str, str, Better, Compute] = (
    "true_share", "share of the variance between views that the true outline explains (R²)",
    "share", "rocks", "higher", _true_share,
)  # fmt: skip


def _definition(
    experiment: DesignExperiment,
    method: str,
    measure: Measure,
    statistic: tuple[str, str, str, str, Better, Compute],
) -> Definition:
    key, title, unit, counted, better, compute = statistic
    suffix = "" if method == REFERENCE else f" ({method})"

    def of_records(records: pd.DataFrame) -> Estimate:
        return compute(cubes_of(records, experiment, method=method, measure=measure.column))

    return Definition(
        key=Key(experiment.name, method, "", measure.column, key),
        title=f"{measure.title}{suffix}: {title}",
        unit=unit,
        counted=counted,
        better=better,
        compute=of_records,
    )


def definitions(
    experiment: DesignExperiment,
    measures: Sequence[MeasureSpec],  # noqa: ARG001
) -> tuple[Definition, ...]:
    """Scores of an experiment, method by method and measure by measure."""
    return tuple(
        _definition(experiment, method, measure, statistic)
        for method in experiment.methods
        for measure in find_method(method).measures
        for statistic in (*_STATISTICS, *((_TRUE,) if measure.view_truth else ()))
    )
