"""Level and order of every 2-D measure by width, on smooth, rough and real outlines, with peers."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from case import Case, Cell, Column, Table
from cases.outlines import Drawn, pebbles, rough_chart
from scipy.stats import kendalltau
from silhouettes import REPORTED_FROM, Floats, Mask, draw

from rockshape.measures import angularity_2d, axis_ratio, ellipse_error, roundness, sphericity_2d
from rockshape.outline.edge import trace_edge
from rockshape.outline.extent import feret_diameters
from rockshape.outline.resample import pixel_smooth
from rockshape.rock.view import RockView
from validation.errors import InputError
from validation.peers.adapters import ADAPTERS
from validation.peers.function import load_function

FLAT = (angularity_2d, ellipse_error, sphericity_2d, axis_ratio)
ROBUST = (roundness.ROBUST, *(module.ROBUST for module in FLAT))
PAPER = {module.ROBUST.column: module.PAPER for module in FLAT}  # by the column of robust
BESIDE = {  # peers' numbers by the measure of ours that tells of the same; equal ones once
    "roundness": (
        ("fast_rs", "roundness"),
        ("partimorph", "roundness"),
        ("partimorph", "circularity"),
        ("scikit-image", "circularity"),
        ("imea", "circularity"),
    ),
    "angularity_2d": (("scikit-image", "solidity"),),
    "ellipse_error": (),
    "sphericity_2d": (
        ("fast_rs", "sphericity"),
        ("partimorph", "sphericity"),
        ("scikit-image", "diameter_ratio"),
        ("imea", "feret_ratio"),
    ),
    "axis_ratio": (("scikit-image", "axis_ratio"), ("partimorph", "axis_ratio")),
}
LEAST_REAL_PX = 65  # of the grains' own width: finer, their ripples are what the hand has drawn
Functions = Mapping[str, Callable[[Mask], Mapping[str, float]]]
Values = dict[tuple[str, str], float]  # by package or method, and name


@dataclass(frozen=True)
class Line:
    """A number by whom, beside which measure of ours, and its values of a kind's outlines."""

    measure: str
    by: str
    name: str
    values: Floats  # (sizes, outlines)


def curves(
    *,
    sizes_px: tuple[int, ...] = (30, 45, 60, 100, 200, 400, 1000),
    outlines: int = 17,
    peers: bool = True,
) -> list[Table]:
    """Read every measure of every outline at each width.

    The level is the mean over outlines over that at the greatest width, τ how far the outlines at
    the first width of 60 px keep the order that they have there.
    """
    functions = _installed() if peers else {}
    kinds = {name: some[:outlines] for name, some in all_outlines().items()}
    lines = {kind: _lines(some, sizes_px, functions) for kind, some in kinds.items()}
    rows: list[tuple[Cell, ...]] = [
        (kind, len(kinds[kind]), line.measure, line.by, line.name, *_level(line))
        for kind, some in lines.items()
        for line in some
    ]
    heads = (Column("outlines"), Column("number", "", "d"), Column("beside"), Column("by"))
    widths = [Column(f"{size} px", "", ".3f") for size in sizes_px]
    table = Table((*heads, Column("measure"), *widths), rows, name="curves")
    return [table, _summary(lines, sizes_px)]


def _summary(lines: Mapping[str, list[Line]], sizes_px: tuple[int, ...]) -> Table:
    """Level at the least width and at 100 px, and the order at 60 px, by kind."""
    near = [min(sizes_px, key=lambda size, to=to: abs(size - to)) for to in (30, 100, 60)]
    low, middle, ranked = (sizes_px.index(size) for size in near)
    rows: list[tuple[Cell, ...]] = []
    for same in zip(*lines.values(), strict=True):
        cells: list[Cell] = []
        for line in same:
            level = _level(line)
            tau = kendalltau(line.values[ranked], line.values[-1], nan_policy="omit").statistic
            cells += [level[low], level[middle], float(tau)]
        rows.append((same[0].by, f"`{same[0].name}`", *cells))
    columns = [Column("by"), Column("measure")]
    for kind in lines:
        columns += [Column(f"{kind}: {near[0]} px", "", ".2f"), Column(f"{near[1]} px", "", ".2f")]
        columns.append(Column(f"τ at {near[2]} px", "", ".2f"))
    return Table(tuple(columns), rows, name="level")


def _level(line: Line) -> list[float]:
    means = np.nanmean(line.values, axis=1)
    return [float(mean / means[-1]) for mean in means]


def _installed() -> Functions:
    """Peers of `validation/peers/adapters` whose packages are there."""
    found = {}
    for name, target in ADAPTERS.items():
        try:
            found[name] = load_function(target)
        except InputError:
            continue
    return found


def _lines(
    outlines: list[Drawn],
    sizes_px: tuple[int, ...],
    functions: Functions,
) -> list[Line]:
    found = [[_read(one.mask(size), functions) for one in outlines] for size in sizes_px]
    lines = []
    for measure in ROBUST:
        names = [("robust", measure.column)]
        if measure.column in PAPER:
            names.append(("paper", PAPER[measure.column].column))
        names += [one for one in BESIDE[measure.column] if one[0] in functions]
        for name in names:
            values = np.array([[one[name] for one in row] for row in found])
            lines.append(Line(measure.column, *name, values))
    return lines


def _read(mask: Mask, functions: Functions) -> Values:
    rock = RockView(mask=mask)
    found = {("robust", one.column): one.read(rock).value for one in ROBUST}
    found |= {("paper", one.column): one.read(rock).value for one in PAPER.values()}
    for name, function in functions.items():
        found |= {(name, column): float(value) for column, value in function(mask).items()}
    return found


def all_outlines() -> dict[str, list[Drawn]]:
    """Outlines of width 1: of the drawn chart, of the chart under waves, of the largest grains."""
    smooth = [
        Drawn(one.shape.outline.outline_px(), one.shape.outline.roundness(), one.seed)
        for one in draw("krumbein", seed=REPORTED_FROM)[::5]
    ]
    edges = [pixel_smooth(trace_edge(mask)) for mask in pebbles()]
    wide = [edge for edge in edges if feret_diameters(edge)[0] >= LEAST_REAL_PX]
    real = [Drawn(edge, float("nan"), number) for number, edge in enumerate(wide)]
    kinds = {"smooth": smooth, "rough": rough_chart(REPORTED_FROM)[::5], "real": real}
    return {kind: [_of_width_1(one) for one in some] for kind, some in kinds.items()}


def _of_width_1(drawn: Drawn) -> Drawn:
    width = feret_diameters(drawn.outline)[0]
    return Drawn(drawn.outline / width, drawn.known, drawn.seed)


OUTLINE_CURVES_CASE = Case(
    name="outline_curves",
    what="level and order of every 2-D measure by width, on smooth, rough and real outlines",
    run=curves,
    smallest={"sizes_px": (30, 60), "outlines": 3, "peers": False},
)
