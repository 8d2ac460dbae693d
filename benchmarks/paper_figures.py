"""The paper's figures 8 and 9 on drawn shapes of known form: order, gaps, and what size does.

Run `python benchmarks/paper_figures.py`. The paper's eight shapes are not published as data. Ours
are drawn with the gaps between neighbours that its text gives, first at the size at which we draw
(a long side of 200 px), then smaller, since the paper's values depend on size in pixels and its
sizes are not told. Values are means over drawings.
"""

import argparse

import numpy as np
from numpy.typing import NDArray
from skimage.draw import polygon

import rockshape
from rockshape.method import methods
from synth.shapes.draw import draw_series
from synth.shapes.series import LONG_SIDE_PX, shape_series

SEED = 22000
# Knobs in the order of the figures. Figure 8: "3 and 4 closer than 1 and 2". Figure 9: the steps
# that the text gives for eccentricity, 2.7 % and 39 % of the way from 0.121 to 0.894.
FIGURES = {
    8: ("roundness", (0.03, 0.40, 0.65, 0.75)),
    9: ("sphericity", (0.18, 0.20, 0.50, 0.90)),
}
PAPER = {
    (8, "angularity_2d_deg"): "58.77 … 15.79; 3–4 closer than 1–2",
    (8, "ellipse_error_px2"): "64.33 … 1.13; 3–4 closer than 1–2",
    (9, "axis_ratio"): "0.121 … 0.894; gaps 2.7 %, 39 %",
    (9, "sphericity_2d"): "0.193 … 0.952; gaps 2.4 %, over 50 %",
}
SHOWN = {
    8: ("angularity_2d_deg", "ellipse_error_px2", "angularity_2d", "ellipse_error", "roundness"),
    9: ("axis_ratio", "sphericity_2d"),
}
LONG_SIDES = (LONG_SIDE_PX, 100.0, 50.0, 25.0)


def labels_of(outlines: tuple[NDArray[np.float64], ...], *, scale: float) -> NDArray[np.int32]:
    """Label image (rows, cols) of closed outlines, (n, 2) as (x, y), drawn at a scale."""
    size = [
        int(np.ceil(scale * max(line[:, axis].max() for line in outlines))) + 9 for axis in (1, 0)
    ]
    labels = np.zeros(size, dtype=np.int32)
    for number, line in enumerate(outlines, start=1):
        labels[polygon(scale * line[:, 1] + 4, scale * line[:, 0] + 4, shape=labels.shape)] = number
    return labels


def values(figure: int, *, method: str, long_px: float, drawings: int) -> dict[str, NDArray]:
    """Values (drawings, shapes) of each measure on a figure's series; NaN where one is refused."""
    series, knobs = FIGURES[figure]
    found: dict[str, list[list[float]]] = {}
    for drawing in range(drawings):
        rng = np.random.default_rng([SEED + drawing])
        drawn = draw_series(shape_series(series, knobs=knobs, rng=rng), rng=rng)
        labels = labels_of(drawn.drawn_px, scale=long_px / LONG_SIDE_PX)
        rocks = rockshape.measure(labels=labels, method=method).rocks
        for column in rocks[0].values:
            found.setdefault(column, []).append([rock.values[column] for rock in rocks])
    return {column: np.array(rows) for column, rows in found.items()}


def in_order(rows: NDArray[np.float64]) -> float:
    """Share of drawings, (drawings, shapes), whose values only rise or only fall as on average."""
    steps = np.diff(rows, axis=1) * np.sign(rows[:, -1:] - rows[:, :1]).mean()
    return float((steps > 0).all(axis=1).mean())


def main() -> None:
    """Print a table for each figure and method, in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--drawings", type=int, default=25)
    args = parser.parse_args()
    for figure, (series, knobs) in FIGURES.items():
        print(f"\nFigure {figure}: series {series}, knobs {', '.join(map(str, knobs))}\n")
        print("| measure | paper | long side, px | values | gaps, % | drawings in order |")
        print("| --- | --- | --- | --- | --- | --- |")
        for method in methods():
            at_size = {
                side: values(figure, method=method, long_px=side, drawings=args.drawings)
                for side in LONG_SIDES
            }
            measures = methods()[method].measures
            columns = [entry.column for entry in measures if entry.column in SHOWN[figure]]
            for column in columns:
                for side, found in at_size.items():
                    rows = found[column]
                    mean = rows.mean(axis=0)
                    gaps = 100 * np.diff(mean) / (mean[-1] - mean[0])
                    paper = PAPER.get((figure, column), "") if method == "paper" else ""
                    print(
                        f"| `{column}` {method} | {paper} | {side:.0f} "
                        f"| {' · '.join(f'{value:.3g}' for value in mean)} "
                        f"| {' · '.join(f'{gap:.0f}' for gap in gaps)} | {in_order(rows):.0%} |"
                    )


if __name__ == "__main__":
    main()
