"""Level of the 2-D measures and the peers' by width, drawn from benchmarks/results.json."""

from pathlib import Path

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from results import load_results

STYLES = {
    "paper": ("0.45", "s"),
    "scikit-image": ("#E69F00", "^"),
    "fast_rs": ("#D55E00", "v"),
    "imea": ("#009E73", "D"),
    "partimorph": ("#CC79A7", "P"),
    "robust": ("#0072B2", "o"),  # above the others
}
OURS = {by: f"rockshape, {by}" for by in ("robust", "paper")}
SECOND = "circularity"  # dashed: where a package has two numbers in one panel
SPAN = (0.5, 2.0)
TICKS = (0.5, 0.7, 1.0, 1.4, 2.0)


def draw(folder: Path) -> None:
    """Write outlines.png: a row for each kind of outline, a column for each measure."""
    (table,) = (
        one for one in load_results()["outline_curves"]["tables"] if one["name"] == "curves"
    )
    heads = [name for name, _, _ in table["columns"]]
    rows = pd.DataFrame(table["rows"], columns=heads)
    widths = [head for head in heads if head.endswith(" px")]
    kinds, measures = rows["outlines"].unique(), rows["beside"].unique()
    figure = Figure(figsize=(13, 7.2), layout="constrained")
    grid = figure.subplots(len(kinds), len(measures), sharex=True, sharey=True)
    for kind, line in zip(kinds, grid, strict=True):
        for measure, panel in zip(measures, line, strict=True):
            own = rows[(rows["outlines"] == kind) & (rows["beside"] == measure)]
            _panel(panel, own, widths)
        line[0].set_ylabel(f"{kind} ({own['number'].iloc[0]} outlines)\nover that at {widths[-1]}")
    for measure, panel in zip(measures, grid[0], strict=True):
        panel.set_title(measure, fontsize=10)
    for panel in grid[-1]:
        panel.set_xlabel("width, px")
    styles = [
        Line2D([], [], color=colour, marker=marker, ms=4, label=OURS.get(by, by))
        for by, (colour, marker) in reversed(STYLES.items())
    ]
    styles.append(Line2D([], [], color="0.2", ls="--", label=SECOND))
    figure.legend(handles=styles, loc="outside lower center", ncols=len(styles), frameon=False)
    figure.savefig(folder / "outlines.png", dpi=100)


def _panel(panel: Axes, own: pd.DataFrame, widths: list[str]) -> None:
    sizes = [int(width.removesuffix(" px")) for width in widths]
    panel.axhspan(0.95, 1.05, color="0.92", lw=0)
    for by, (colour, marker) in STYLES.items():
        for _, one in own[own["by"] == by].iterrows():
            panel.plot(
                sizes,
                one[widths].to_numpy(float),
                color=colour,
                marker=marker,
                ms=4,
                lw=2.0 if by == "robust" else 1.2,
                ls="--" if one["measure"] == SECOND else "-",
            )
    panel.set(xscale="log", yscale="log", ylim=SPAN)
    panel.set_xticks(sizes, [str(size) for size in sizes], fontsize=8)
    panel.set_yticks(TICKS, [f"{tick:g}" for tick in TICKS])
    panel.minorticks_off()
    panel.grid(alpha=0.3)
