"""Roundness of pebbles at a third of their resolution beside what is known of drawn outlines."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from case import Column, Table
from cases.outlines import rough_chart
from limit_scores import KNOWN, Scored, scored
from mask_regression import MaskRegression
from silhouettes import REPORTED_FROM, Floats, Mask, fill, turned
from skimage.measure import find_contours

from rockshape.measures import roundness
from rockshape.outline.edge import trace_edge
from rockshape.outline.extent import feret_diameters
from rockshape.outline.form import FORM_SHARE, LEAST_SIGMA_PX, form_of
from rockshape.outline.resample import pixel_smooth
from rockshape.outline.roundness import wadell_roundness
from rockshape.outline.trace import signed_area
from rockshape.rock.view import RockView
from validation.kinds.pebbles.sheet import pebble_masks, shrunk
from validation.kinds.pebbles.spec import FACTORS, PebblesExperiment
from validation.statistics import Block
from validation.suite.suite import load_suite

FACTOR = FACTORS["third"]
FINER = 8  # pixels to a side of one, by which its grey is told
TUNED, REPORTED = 0, REPORTED_FROM  # seeds of the charts
TITLES = {"pebbles": "scale chosen on them", "pebbles-held-out": "held out"}
STATISTICS = ("tau", "change")
PEBBLES = "the pebbles"
LIKE = "drawn outlines, as wide and as round"
AGAIN = "the pebbles' outlines, drawn anew"
Readings = list[dict[str, Floats]]  # a set: of each picture, the outlines' values by reading


@dataclass(frozen=True)
class Reading:
    """A reading of an outline, beside another."""

    words: str
    of: str
    beside: str


EXACT, FULL, THIRD, OTHER = "exact", "full", "third", "other grid"
GREY, LEARNT, SCALE = "grey", "learnt", "scale"
FIRST = Reading("a third beside full resolution", THIRD, FULL)
READINGS = (
    FIRST,
    Reading("a third beside the exact value", THIRD, EXACT),
    Reading("full resolution beside the exact value", FULL, EXACT),
    Reading("a third beside a third on another grid of pixels", OTHER, THIRD),
    Reading("a third, edge at half of the pixels' grey, beside the exact value", GREY, EXACT),
    Reading("a third, by a regression on its mask, beside the exact value", LEARNT, EXACT),
    Reading("exact outline at the scale that a third asks, beside the exact value", SCALE, EXACT),
)
Scores = dict[tuple[str, str, str, str], Scored]  # by experiment, outlines, reading and statistic


@dataclass(frozen=True, eq=False)
class Chart:
    """Rough outlines of width 1 with the exact values of the robust roundness."""

    outlines: Sequence[Floats]
    values: Floats

    @classmethod
    def of(cls, seed: int, charts: int) -> "Chart":
        """So many charts from a seed on."""
        drawn = [one for k in range(charts) for one in rough_chart(seed + k)]
        outlines = [one.outline / feret_diameters(one.outline)[0] for one in drawn]
        return cls(outlines, np.array([exact_value(one) for one in outlines]))

    def nearest(self, value: float, count: int) -> list[Floats]:
        """The outlines whose values are the nearest to one."""
        return [self.outlines[k] for k in np.argsort(np.abs(self.values - value))[:count]]


def exact_value(outline: Floats) -> float:
    """Robust roundness of an outline (n, 2) without pixels."""
    form = form_of(outline, staircase=False)
    return float("nan") if form is None else wadell_roundness(form)


def pebble_scores(*, experiments: int, sets: int, charts: int) -> Scores:
    """Order and change of the median of each reading, of pebbles and of sets of outlines like them.

    The intervals of outlines are what 95 % of sets as large as the pebbles' have.
    """
    told, drawn = Chart.of(TUNED, 4 * charts), Chart.of(REPORTED, charts)
    found: Scores = {}
    for experiment in _experiments()[:experiments]:
        masks = list(_pictures(experiment))
        lines = [[pixel_smooth(trace_edge(mask)) for mask in some] for some in masks]
        learnt = _taught([line for some in lines for line in some], told, 2 * sets)
        rng = np.random.default_rng(REPORTED)
        kinds = {
            PEBBLES: [[_of_masks(some) for some in masks]],
            AGAIN: [[_of_outlines(some, rng) for some in lines] for _ in range(sets)],
            LIKE: [
                [_of_outlines(some, rng, learnt) for some in one]
                for one in _alike(lines, drawn, sets)
            ],
        }
        for kind, some in kinds.items():
            for reading in READINGS:
                if {reading.of, reading.beside} <= some[0][0].keys():
                    for statistic in STATISTICS:
                        key = (experiment.name, kind, reading.words, statistic)
                        found[key] = _score(key, reading, some)
    return found


def pebble_table(found: Scores) -> Table:
    """Table of the readings."""
    columns = [Column("photographs"), Column("outlines"), Column("read")]
    columns += [Column("order, τ", "", ".3f"), Column("95 %"), Column("pairs", "", "d")]
    columns += [Column("change of the median", "", "+.3f"), Column("95 %")]
    rows = []
    for (experiment, kind, words, statistic), tau in found.items():
        if statistic == "tau":
            change = found[experiment, kind, words, "change"]
            rows.append((TITLES[experiment], kind, words, *tau.cells(), *change.cells()[:2]))
    return Table(columns, rows, name="pebbles")


def _score(key: tuple[str, str, str, str], reading: Reading, sets: Sequence[Readings]) -> Scored:
    blocks = [
        [Block(values=one[reading.of][None], truth=one[reading.beside]) for one in some]
        for some in sets
    ]
    name = f"{key[0]}.robust.third.roundness"
    whole = scored(key[-1], [block for some in blocks for block in some], name=name)
    if len(sets) == 1:
        return whole
    each = [KNOWN[key[-1]].compute(some).value for some in blocks]
    low, high = np.nanpercentile(each, (2.5, 97.5)).tolist()
    return replace(whole, low=low, high=high)


def _experiments() -> list[PebblesExperiment]:
    suite = load_suite("outlines")
    return [one for one in suite.experiments if isinstance(one, PebblesExperiment)]


def _pictures(experiment: PebblesExperiment) -> Iterator[list[Mask]]:
    """Masks of each picture's pebbles."""
    for number in range(experiment.pictures.count):
        labels = experiment.pictures.picture(experiment.seed, number).truth.labels
        yield [] if labels is None else pebble_masks(labels, experiment.min_width_px)


def _alike(lines: Sequence[Sequence[Floats]], chart: Chart, sets: int) -> list[list[list[Floats]]]:
    """Sets of outlines as wide as each of the lines and nearly as round, by set and picture."""
    likes = [[_like(line, chart, sets) for line in some] for some in lines]
    return [[[one[k] for one in some] for some in likes] for k in range(sets)]


def _like(line: Floats, chart: Chart, count: int) -> list[Floats]:
    width_px = feret_diameters(line)[0]
    return [width_px * one for one in chart.nearest(exact_value(line), count)]


def _taught(lines: Sequence[Floats], chart: Chart, count: int) -> MaskRegression:
    """Regression taught on so many outlines like each line, at a third of the resolution."""
    rng = np.random.default_rng(TUNED)
    outlines = [one for line in lines for one in _like(line, chart, count)]
    masks = [_third(turned(one, rng.uniform(0, 2 * np.pi)), rng) for one in outlines]
    return MaskRegression.taught(masks, [exact_value(one) for one in outlines])


def _of_masks(masks: Sequence[Mask]) -> dict[str, Floats]:
    return {
        FULL: np.array([_read(mask) for mask in masks]),
        THIRD: np.array([_read(shrunk(mask, FACTOR)) for mask in masks]),
    }


def _of_outlines(
    outlines: Sequence[Floats], rng: np.random.Generator, learnt: MaskRegression | None = None
) -> dict[str, Floats]:
    """Readings of outlines, each turned and laid on grids of pixels anyhow."""
    found: dict[str, list[float]] = {}
    for outline in outlines:
        line = turned(outline, rng.uniform(0, 2 * np.pi))
        full = fill(line + rng.uniform(0, FACTOR, 2))
        third = shrunk(full, FACTOR)
        values = {
            EXACT: exact_value(line),
            FULL: _read(full),
            THIRD: _read(third),
            OTHER: _read(_third(line, rng)),
            GREY: _of_grey(line / FACTOR + rng.uniform(0, 1, 2)),
            SCALE: _at_scale(line / FACTOR),
        }
        if learnt is not None:
            values[LEARNT] = learnt(third)
        for name, value in values.items():
            found.setdefault(name, []).append(value)
    return {name: np.array(some) for name, some in found.items()}


def _third(line: Floats, rng: np.random.Generator) -> Mask:
    return shrunk(fill(line + rng.uniform(0, FACTOR, 2)), FACTOR)


def _read(mask: Mask) -> float:
    return roundness.ROBUST.read(RockView(mask=mask)).value


def _of_grey(line_px: Floats) -> float:
    """Roundness of the contour at which pixels are half covered."""
    fine = fill(FINER * line_px, margin=4 * FINER)
    rows, cols = (side // FINER for side in fine.shape)
    blocks = fine[: rows * FINER, : cols * FINER].reshape(rows, FINER, cols, FINER)
    contour = max(find_contours(blocks.mean(axis=(1, 3)), 0.5), key=len)
    rock = RockView(mask=np.ones((1, 1), dtype=np.bool_), subpixel_px=contour[:-1, ::-1])
    return roundness.ROBUST.read(rock).value


def _at_scale(line_px: Floats) -> float:
    """Roundness of an exact outline at the scale that pixels ask of its size."""
    radius_px = float(np.sqrt(abs(signed_area(line_px)) / np.pi))
    form = form_of(line_px, staircase=False, share=max(FORM_SHARE, LEAST_SIGMA_PX / radius_px))
    return float("nan") if form is None else wadell_roundness(form)
