"""Calibration of the intervals and standard deviations, drawn from benchmarks/results.json."""

from pathlib import Path

import matplotlib as mpl
import pandas as pd
from results import load_results

mpl.use("Agg")
from matplotlib import pyplot as plt

COLOURS = ("#0072B2", "#D55E00")
GOAL = (0.86, 0.94)


def draw(folder: Path) -> None:
    """Write uncertainty.png: coverage of each value's interval, and of standard deviations."""
    values, levels = (_table(name) for name in ("values", "levels"))
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(11.0, 4.4), layout="constrained", width_ratios=(1.6, 1)
    )
    names = values["value"].unique().tolist()
    left.axhspan(*GOAL, color="0.9", lw=0)
    left.axhline(0.9, color="0.4", lw=0.8)
    right.plot([0, 1], [0, 1], color="0.4", lw=0.8)
    for number, (one, colour) in enumerate(zip(levels.columns[1:], COLOURS, strict=False)):
        own = values[values["rocks"] == one]
        place = [names.index(name) + 0.18 * (number - 0.5) for name in own["value"]]
        left.plot(place, own["coverage"], "o", color=colour, ms=5, label=one)
        right.plot(levels.iloc[:, 0], levels[one], "o-", color=colour, ms=4, lw=1.2, label=one)
    left.set_xticks(range(len(names)), [name.strip("`") for name in names], rotation=50, ha="right")
    left.set(
        ylim=(min(0.5, values["coverage"].min() - 0.05), 1.02),
        ylabel="true values in the 90 % interval",
    )
    right.set(
        xlabel="share within z standard deviations, normal errors",
        ylabel="share of true values",
        xlim=(0, 1),
        ylim=(0, 1),
    )
    for axis, corner in ((left, "lower left"), (right, "lower right")):
        axis.grid(visible=True, alpha=0.25)
        axis.legend(fontsize="small", loc=corner)
    figure.savefig(folder / "uncertainty.png", dpi=100)
    plt.close(figure)


def _table(name: str) -> pd.DataFrame:
    (found,) = (one for one in load_results()["uncertainty"]["tables"] if one["name"] == name)
    return pd.DataFrame(found["rows"], columns=[each for each, _, _ in found["columns"]])
