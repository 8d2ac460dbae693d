"""The paper's figures 8 and 9 on drawn shapes of known form: order, gaps and the effect of size."""

import numpy as np
from case import Case, Cell, Column, Table
from numpy.typing import NDArray
from skimage.draw import polygon

import rockshape
from synth.shapes.draw import draw_series
from synth.shapes.series import shape_series
from synth.shapes.shape import LONG_SIDE_PX

SEED = 22_000
# Knobs in the order of the figures. Figure 8: "3 and 4 closer than 1 and 2". Figure 9: the steps
# that the text gives for eccentricity, 2.7 % and 39 % of the way from 0.121 to 0.894.
FIGURES = {8: ("roundness", (0.03, 0.40, 0.65, 0.75)), 9: ("sphericity", (0.18, 0.20, 0.50, 0.90))}
SHOWN = {
    8: (
        ("paper", "angularity_2d_deg", "58.77 … 15.79"),
        ("paper", "ellipse_error_px2", "64.33 … 1.13"),
        ("robust", "angularity_2d", ""),
        ("robust", "ellipse_error", ""),
        ("robust", "roundness", ""),
    ),
    9: (
        ("paper", "axis_ratio", "0.121 … 0.894"),
        ("paper", "sphericity_2d", "0.193 … 0.952"),
        ("robust", "axis_ratio", ""),
        ("robust", "sphericity_2d", ""),
    ),
}


def figures(
    *, drawings: int = 25, long_sides_px: tuple[float, ...] = (200.0, 100.0, 50.0, 25.0)
) -> list[Table]:
    """Measure four shapes with the gaps that the paper's text tells, at several sizes."""
    rows: list[tuple[Cell, ...]] = []
    for figure, shown in SHOWN.items():
        found = {
            (method, side): _values(figure, method=method, long_px=side, drawings=drawings)
            for method in ("paper", "robust")
            for side in long_sides_px
        }
        for method, column, paper in shown:
            for side in long_sides_px:
                values = found[method, side][column]
                mean = values.mean(axis=0)
                gaps = 100 * np.diff(mean) / (mean[-1] - mean[0])
                rows.append(
                    (
                        figure,
                        f"`{column}`",
                        method,
                        paper if side == long_sides_px[0] else "",
                        side,
                        " · ".join(f"{value:.3g}" for value in mean),
                        " · ".join(f"{gap:.0f}" for gap in gaps),
                        100 * _in_order(values),
                    )
                )
    columns = (
        Column("figure", "", "d"),
        Column("measure"),
        Column("method"),
        Column("paper's values"),
        Column("long side", "px", ".0f"),
        Column("ours"),
        Column("gaps", "%"),
        Column("drawings wholly in order", "%", ".0f"),
    )
    return [Table(columns, rows)]


def _values(
    figure: int, *, method: str, long_px: float, drawings: int
) -> dict[str, NDArray[np.float64]]:
    """Return values (drawings, shapes) of each measure on a figure's series."""
    series, knobs = FIGURES[figure]
    found: dict[str, list[list[float]]] = {}
    for drawing in range(drawings):
        rng = np.random.default_rng([SEED + drawing])
        drawn = draw_series(shape_series(series, knobs=knobs, rng=rng), rng=rng)
        labels = _labels(drawn.drawn_px, scale=long_px / LONG_SIDE_PX)
        rocks = rockshape.measure(labels=labels, method=method).rocks
        for column in rocks[0].values:
            found.setdefault(column, []).append([rock.values[column] for rock in rocks])
    return {column: np.array(rows) for column, rows in found.items()}


def _labels(outlines: tuple[NDArray[np.float64], ...], *, scale: float) -> NDArray[np.int32]:
    """Return the label image (rows, cols) of closed outlines, (n, 2) as (x, y), at a scale."""
    size = [
        int(np.ceil(scale * max(line[:, axis].max() for line in outlines))) + 9 for axis in (1, 0)
    ]
    labels = np.zeros(size, dtype=np.int32)
    for number, line in enumerate(outlines, start=1):
        labels[polygon(scale * line[:, 1] + 4, scale * line[:, 0] + 4, shape=labels.shape)] = number
    return labels


def _in_order(rows: NDArray[np.float64]) -> float:
    """Return the share of drawings whose values only rise or only fall as on average."""
    steps = np.diff(rows, axis=1) * np.sign(rows[:, -1:] - rows[:, :1]).mean()
    return float((steps > 0).all(axis=1).mean())


PAPER_FIGURES_CASE = Case(
    name="paper_figures",
    what="figures 8 and 9 of the paper on drawn shapes, means over drawings",
    run=figures,
    smallest={"drawings": 1, "long_sides_px": (50.0,)},
)
