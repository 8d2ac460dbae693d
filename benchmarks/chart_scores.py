"""Scores of roundness and angularity on drawn outlines: a rough chart, rocks of known corners."""

from collections.abc import Callable
from functools import partial

import numpy as np
from cases.outlines import readers, rough_chart
from cases.roundness import rock_outlines
from limit_scores import Scored
from silhouettes import REPORTED_FROM, Floats, Mask, draw

from rockshape.measures.angularity_2d import angularity_beyond_form
from rockshape.outline.form import form_of
from rockshape.outline.roundness import wadell_roundness
from validation.scores.score import score_rng
from validation.statistics.interval import Weighted, bootstrap_interval, of_sample
from validation.statistics.weighted import mean, ratio, square_sum

CHART_SIZES_PX = (100, 200, 500)
ROCKS_PX = 100
_MEASURES = ("roundness", "angularity_2d")


def chart_scores(*, every: int = 1, scenes: int = 14) -> dict[str, Scored]:
    """Scores by name: `chart.SIZE.MEASURE.STATISTIC` and `corners.SIZE.roundness.STATISTIC`.

    Of the chart every so many of the outlines are taken.
    """
    chart = rough_chart(REPORTED_FROM)[::every]
    known = np.array([one.known for one in chart])
    read = readers()
    found = {}
    for size_px in CHART_SIZES_PX:
        masks = [one.mask(size_px) for one in chart]
        round_of, bend_of = (_values(read[f"`{name}`"], masks) for name in _MEASURES)
        head = f"chart.{size_px}"
        found |= {
            f"{head}.roundness.r": partial(_correlation, known, round_of),
            f"{head}.roundness.error": partial(mean, np.abs(round_of - known)),
            f"{head}.angularity_2d.r": partial(_correlation, -known, bend_of),
        }
    rocks = rock_outlines(range(REPORTED_FROM, REPORTED_FROM + scenes))
    exact = np.array([truth for _, truth in rocks])
    told = _values(read["`roundness`"], [drawn(ROCKS_PX) for drawn, _ in rocks])
    head = f"corners.{ROCKS_PX}.roundness"
    on_rocks = {
        f"{head}.r": partial(_correlation, exact, told),
        f"{head}.bias": partial(mean, told - exact),
    }
    return {name: _scored(name, one, len(chart)) for name, one in found.items()} | {
        name: _scored(name, one, len(rocks)) for name, one in on_rocks.items()
    }


def smooth_scores(*, every: int = 1) -> dict[str, Scored]:
    """Scores of the chart's exact outlines without their waves: `MEASURE.STATISTIC`."""
    outlines = [one.shape.outline for one in draw("krumbein", seed=REPORTED_FROM)[::every]]
    known = np.array([one.roundness() for one in outlines])
    forms = [form_of(one.outline_px(), staircase=False) for one in outlines]
    round_of, bend_of = (
        np.array([np.nan if form is None else read(form) for form in forms])
        for read in (wadell_roundness, angularity_beyond_form)
    )
    found = {
        "roundness.error": partial(mean, np.abs(round_of - known)),
        "angularity_2d.r": partial(_correlation, -known, bend_of),
    }
    return {name: _scored(f"smooth.{name}", one, len(known)) for name, one in found.items()}


def _values(reader: Callable[[Mask], float], masks: list[Mask]) -> Floats:
    return np.array([reader(mask) for mask in masks])


def _correlation(one: Floats, other: Floats, weights: Floats) -> Floats:
    """Pearson's correlation of values (n,) in each draw, (draws,), of weights (draws, n)."""
    off, away = (each - mean(each, weights)[:, None] for each in (one, other))
    squares = square_sum(one, weights) * square_sum(other, weights)
    return ratio(np.vecdot(weights, off * away), np.sqrt(squares))


def _scored(name: str, statistic: Weighted, shapes: int) -> Scored:
    low, high = bootstrap_interval(statistic, shapes, rng=score_rng(name))
    return Scored(of_sample(statistic, shapes), low, high, shapes)
