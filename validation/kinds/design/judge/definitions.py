"""Scores of a designed experiment: how far a rock's value moves, and what moves it."""

from collections.abc import Sequence

import pandas as pd

from rockshape.measures.measure import Measure
from rockshape.method import find_method
from validation.kinds.design.judge.statistics import (
    Compute,
    cv,
    cv_clean,
    measured_share,
    order,
    share_of,
    shared_movement,
    true_share,
)
from validation.kinds.design.judge.tensors import cubes_of
from validation.kinds.design.judge.variance_components import CAUSES
from validation.kinds.design.spec import CLEAN, NOISY, STATES, DesignExperiment
from validation.peers import MeasureSpec
from validation.scores.score import Better, Definition, Estimate, Key
from validation.scores.titles import REFERENCE
from validation.statistics import (
    across_views,
    between_views,
    weighted_share_in_order,
    weighted_tau_b,
    within_views,
)

TITLES = {
    "view": "the view",
    "distance": "distance",
    "light": "light",
    "noise": "range noise",
    "segmentation": "segmentation",
    "rest": "the grid of pixels",
}


_STATISTICS: tuple[tuple[str, str, str, str, Better, Compute], ...] = (
    ("cv", "how far a rock's value moves in all, relative (root of mean square)", "1", "rocks",
     "lower", cv),
    ("cv_clean", "the same with true masks and exact range", "1", "rocks", "lower", cv_clean),
    *(
        (f"share_{cause}", f"share of a rock's variance by {TITLES[cause]}", "share", "rocks",
         "neither", share_of(cause))
        for cause in CAUSES
    ),
    *(
        (f"measured_{state}", f"cells with a value, {state}", "share", "cells", "higher",
         measured_share(state))
        for state in STATES
    ),
    ("shared", "what all rocks of a frame share of their movement", "share", "pairs of rocks",
     "neither", shared_movement(NOISY)),
    ("shared_clean", "the same with true masks and exact range", "share", "pairs of rocks",
     "neither", shared_movement(CLEAN)),
    ("tau_frames", "agreement of two frames' rankings (mean pairwise τ_b)", "1", "pairs",
     "higher", order(NOISY, between_views, weighted_tau_b)),
    ("tau_frames_clean", "the same with true masks and exact range", "1", "pairs", "higher",
     order(CLEAN, between_views, weighted_tau_b)),
    ("order_within", "pairs of one frame in the order of the rocks' means", "share", "pairs",
     "higher", order(NOISY, within_views, weighted_share_in_order)),
    ("order_across", "pairs of any two frames in the order of the rocks' means", "share", "pairs",
     "higher", order(NOISY, across_views, weighted_share_in_order)),
)  # fmt: skip
_TRUE: tuple[str, str, str, str, Better, Compute] = (
    "true_share", "share of the variance between views that the true outline explains (R²)",
    "share", "rocks", "higher", true_share,
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
    _measures: Sequence[MeasureSpec],
) -> tuple[Definition, ...]:
    """Scores of an experiment, method by method and measure by measure."""
    return tuple(
        _definition(experiment, method, measure, statistic)
        for method in experiment.methods
        for measure in find_method(method).measures
        for statistic in (*_STATISTICS, *((_TRUE,) if measure.view_truth else ()))
    )
