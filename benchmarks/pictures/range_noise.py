"""Estimated over true range noise, drawn from benchmarks/results.json."""

from pathlib import Path

import matplotlib as mpl
import pandas as pd
from results import load_results

mpl.use("Agg")
from matplotlib import pyplot as plt

STYLES = (("#0072B2", "o"), ("#E69F00", "s"), ("#D55E00", "^"))


def draw(folder: Path) -> None:
    """Write range_noise.png: a panel for each ground, the range of ratios at each level."""
    (table,) = (one for one in load_results()["range_noise"]["tables"] if one["name"] == "ratios")
    rows = pd.DataFrame(table["rows"], columns=[name for name, _, _ in table["columns"]])
    grounds = rows["ground"].unique()
    figure, axes = plt.subplots(
        1, len(grounds), figsize=(13.0, 3.6), layout="constrained", sharey=True
    )
    for axis, ground in zip(axes, grounds, strict=True):
        axis.axhspan(0.95, 1.05, color="0.9", lw=0)
        axis.axhline(1.0, color="0.4", lw=0.8)
        panel = rows[rows["ground"] == ground].groupby("estimator", sort=False)
        for number, ((name, own), (colour, marker)) in enumerate(zip(panel, STYLES, strict=True)):
            axis.errorbar(
                own["noise"] * (1 + 0.06 * (number - 1)),  # side by side
                own["mean"],
                yerr=[own["mean"] - own["least"], own["greatest"] - own["mean"]],
                color=colour,
                marker=marker,
                ms=5,
                lw=1.2,
                label=name,
            )
        levels = sorted(rows["noise"].unique())
        axis.set(xscale="log", title=ground, xlabel="disparity noise σ_d, px")
        axis.set_xticks(levels, [f"{level:g}" for level in levels])
        axis.minorticks_off()
        axis.grid(visible=True, alpha=0.25)
    axes[0].set_ylabel("estimated / true standard deviation")
    axes[0].legend(fontsize="small", loc="upper left")
    figure.savefig(folder / "range_noise.png", dpi=100)
    plt.close(figure)
