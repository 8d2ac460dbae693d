"""Robust 2-D measures on rough outlines: a stand-in for Krumbein's chart, rocks, real pebbles."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from case import Case, Cell, Column, Table
from cases.roundness import rock_outlines
from numpy.typing import NDArray
from scipy.stats import kendalltau
from silhouettes import REPORTED_FROM, Floats, Mask, draw, fill, turned

from rockshape.measures import angularity_2d, ellipse_error, roundness
from rockshape.measures.angularity_2d import angularity_beyond_form
from rockshape.outline.descriptors import describe
from rockshape.outline.edge import trace_edge
from rockshape.outline.form import form_of
from rockshape.outline.roundness import wadell_roundness
from rockshape.rock.view import RockView
from synth.shapes.outline import RoundedPolygon
from validation.kinds.pebbles.sheet import pebble_masks, shrunk
from validation.kinds.pebbles.spec import PebblesExperiment
from validation.suite.suite import load_suite

WAVELENGTHS = (2.0, 1.0, 0.5, 0.25, 0.125, 0.0625)  # over √(A/π), all of one height
HEIGHT = 0.010  # RMS of all, over √(A/π): with it the former roundness fell as on the chart itself
STEPS = 4096
SHARES = (0.08, 0.10, 0.12, 0.14, 0.17, 0.20)
Reader = Callable[[Mask], float]


@dataclass(frozen=True, eq=False)
class Drawn:
    """An outline of length 1 that can be drawn at a size, and its roundness."""

    outline: Floats  # (n, 2)
    known: float
    seed: int

    def mask(self, size_px: float) -> Mask:
        """Pixels inside, turned and shifted anew at each size."""
        rng = np.random.default_rng([self.seed, round(size_px)])
        placed = turned(self.outline * size_px, rng.uniform(0, 2 * np.pi))
        return fill(placed + rng.uniform(0, 1, 2))


def rough_chart(seed: int) -> list[Drawn]:
    """The chart's 81 outlines under waves of six lengths: a stand-in for drawn pebbles."""
    found = []
    for shape in draw("krumbein", seed=seed):
        outline = shape.shape.outline
        points = _roughened(outline, np.random.default_rng(shape.seed))
        found.append(Drawn(points / shape.shape.sides_px[0], outline.roundness(), shape.seed))
    return found


def _roughened(outline: RoundedPolygon, rng: np.random.Generator) -> Floats:
    """Points of an outline with heights along the rays from their mean."""
    closed = outline.outline_px()
    closed = np.concatenate([closed, closed[:1]])
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(closed, axis=0).T))])
    places = along[-1] / STEPS * np.arange(STEPS)
    points = np.column_stack([np.interp(places, along, side) for side in closed.T])
    radius = np.sqrt(outline.area_px2() / np.pi)
    heights = np.zeros(STEPS)
    for wavelength in WAVELENGTHS:
        middle = along[-1] / (wavelength * radius)
        low, high = int(np.ceil(middle / np.sqrt(2))), int(middle * np.sqrt(2))
        waves = np.zeros(STEPS // 2 + 1, dtype=complex)
        waves[low : high + 1] = rng.normal(size=(2, high + 1 - low)).T @ (1, 1j)
        band = np.fft.irfft(waves, STEPS)
        heights += band / band.std()
    middle_px = points.mean(axis=0)
    arms = points - middle_px
    share = HEIGHT * radius * heights / heights.std() / np.hypot(*arms.T)
    return np.asarray(middle_px + arms * (1 + share[:, None]))


def chart_by_size(
    *, sizes_px: tuple[int, ...] = (60, 100, 200, 500, 1000), charts: int = 1
) -> list[Table]:
    """Correlation of 2-D measures with the class of graded rough silhouettes, and level by size."""
    shapes = [one for chart in range(charts) for one in rough_chart(REPORTED_FROM + chart)]
    known = np.array([one.known for one in shapes])
    rows: list[tuple[Cell, ...]] = []
    for name, reader in readers().items():
        found = {size: np.array([reader(one.mask(size)) for one in shapes]) for size in sizes_px}
        marks = [abs(float(np.corrcoef(known, values)[0, 1])) for values in found.values()]
        rows.append((name, *marks))
        if name == "`roundness`":
            errors = [float(np.abs(values - known).mean()) for values in found.values()]
            top = [float(values[known > 0.85].mean()) for values in found.values()]
            levels = [("mean absolute error", *errors), ("mean of class 0.9", *top)]
    heads = [Column(f"{size} px", "", ".3f") for size in sizes_px]
    return [
        Table((Column("measure"), *heads), rows, name="chart"),
        Table((Column("`roundness`"), *heads), levels, name="level"),
    ]


def readers() -> dict[str, Reader]:
    """The robust measures, and others beside them."""
    return {
        "`roundness`": partial(_read, roundness.ROBUST),
        "`angularity_2d`": partial(_read, angularity_2d.ROBUST),
        "`ellipse_error`": partial(_read, ellipse_error.ROBUST),
        "`angularity_2d_deg`, paper": partial(_read, angularity_2d.PAPER),
        "solidity": lambda mask: describe(mask).solidity,
        "circularity": lambda mask: describe(mask).circularity,
    }


def _read(measure: roundness.Measure, mask: Mask) -> float:
    return measure.read(RockView(mask=mask)).value


def pebbles() -> list[Mask]:
    """Pebbles of the photographs with masks made by hand, as the suite `outlines` measures them."""
    suite = load_suite("outlines")
    found: list[Mask] = []
    for experiment in suite.experiments:
        if isinstance(experiment, PebblesExperiment):
            for number in range(experiment.pictures.count):
                labels = experiment.pictures.picture(experiment.seed, number).truth.labels
                if labels is not None:
                    found += pebble_masks(labels, experiment.min_width_px)
    return found


def ablation(*, charts: int = 1, scenes: int = 14, draws: int = 400) -> list[Table]:
    """What the scale of the form does to roundness and angularity, on each set."""
    rough = [one for chart in range(charts) for one in rough_chart(REPORTED_FROM + chart)]
    rocks = rock_outlines(range(REPORTED_FROM, REPORTED_FROM + scenes))
    drawn = [(one.mask(200), one.known) for one in rough]
    many = [(drawer(100), known) for drawer, known in rocks]
    grains = pebbles()
    rows: list[tuple[Cell, ...]] = []
    for share in SHARES:
        chart, rock = (_roundness_at(share, some) for some in (drawn, many))
        bends = np.array([_angularity_at(share, mask) for mask, _ in drawn])
        pairs = np.array(
            [[_roundness_of(share, shrunk(mask, by)) for by in (1, 3)] for mask in grains]
        )
        known, grade = (np.array([each for _, each in some]) for some in (many, drawn))
        rows.append(
            (
                f"{share:.2f}",
                _with_interval(_correlation, grade, chart, draws=draws),
                _with_interval(_correlation, known, rock, draws=draws),
                float((rock - known).mean()),
                _with_interval(_rank_correlation, *pairs.T, draws=draws),
                _with_interval(_correlation, -grade, bends, draws=draws),
            )
        )
    columns = (
        Column("scale, of √(A/π)"),
        Column("`roundness`, rough chart at 200 px: r"),
        Column("rocks of eleven corners at 100 px: r"),
        Column("bias", "", "+.3f"),
        Column("pebbles at 1/3 beside full: τ"),
        Column("`angularity_2d`, rough chart: r"),
    )
    return [Table(columns, rows)]


def _roundness_at(share: float, some: list[tuple[Mask, float]]) -> Floats:
    return np.array([_roundness_of(share, mask) for mask, _ in some])


def _roundness_of(share: float, mask: Mask) -> float:
    form = form_of(trace_edge(mask), staircase=True, share=share)
    return float("nan") if form is None else wadell_roundness(form)


def _angularity_at(share: float, mask: Mask) -> float:
    form = form_of(trace_edge(mask), staircase=True, share=share)
    return float("nan") if form is None else angularity_beyond_form(form)


def _correlation(one: Floats, other: Floats) -> float:
    return float(np.corrcoef(one, other)[0, 1])


def _rank_correlation(one: Floats, other: Floats) -> float:
    return float(kendalltau(one, other).statistic)


def _with_interval(
    statistic: Callable[[Floats, Floats], float], one: Floats, other: Floats, *, draws: int
) -> str:
    """Statistic with the 95 % interval of a bootstrap over shapes."""
    rng = np.random.default_rng(0)
    again: list[NDArray[np.intp]] = [rng.integers(len(one), size=len(one)) for _ in range(draws)]
    low, high = np.nanpercentile([statistic(one[i], other[i]) for i in again], (2.5, 97.5))
    return f"{statistic(one, other):.2f} ({low:.2f} … {high:.2f})"


OUTLINES_CASE = Case(
    name="outlines",
    what="2-D measures on 81 graded rough silhouettes by size in pixels",
    run=chart_by_size,
    smallest={"sizes_px": (60,), "charts": 1},
)
FORM_SCALE_CASE = Case(
    name="form_scale",
    what="what the scale of the form does to roundness and angularity",
    run=ablation,
    smallest={"charts": 1, "scenes": 1, "draws": 20},
)
