"""Calibration of the intervals and standard deviations, drawn from benchmarks/results.json."""

from pathlib import Path

import matplotlib as mpl
import pandas as pd
from results import load_results

mpl.use("Agg")
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

COLOURS = ("#0072B2", "#D55E00", "#009E73")
GOAL = (0.86, 0.94)
PANELS = {"outlines that labels give": "uncertainty", "found outlines": "found_uncertainty"}


def draw(folder: Path) -> None:
    """Write uncertainty.png: coverage of each value's interval, and of standard deviations."""
    figure, axes = plt.subplots(
        2, 2, figsize=(11.0, 8.4), layout="constrained", width_ratios=(1.6, 1)
    )
    for (left, right), (title, case) in zip(axes, PANELS.items(), strict=True):
        _draw_coverage(left, _table(case, "values"))
        _draw_levels(right, _table(case, "levels"))
        left.set_title(title, loc="left")
    figure.savefig(folder / "uncertainty.png", dpi=100)
    plt.close(figure)


def _draw_coverage(axis: Axes, values: pd.DataFrame) -> None:
    """Share of true values in each value's interval, a point for each set of rocks."""
    names = values["value"].unique().tolist()
    axis.axhspan(*GOAL, color="0.9", lw=0)
    axis.axhline(0.9, color="0.4", lw=0.8)
    sets = values["rocks"].unique()
    for number, (one, colour) in enumerate(zip(sets, COLOURS, strict=False)):
        own = values[values["rocks"] == one]
        place = [names.index(name) + 0.18 * (number - (len(sets) - 1) / 2) for name in own["value"]]
        axis.plot(place, own["coverage"], "o", color=colour, ms=5, label=one)
    axis.set_xticks(range(len(names)), [name.strip("`") for name in names], rotation=50, ha="right")
    axis.set(ylim=(0.5, 1.02), ylabel="true values in the 90 % interval")
    axis.grid(visible=True, alpha=0.25)
    axis.legend(fontsize="small", loc="lower left")


def _draw_levels(axis: Axes, levels: pd.DataFrame) -> None:
    """Share of true values within z standard deviations, beside a normal distribution's."""
    axis.plot([0, 1], [0, 1], color="0.4", lw=0.8)
    for one, colour in zip(levels.columns[1:], COLOURS, strict=False):
        axis.plot(levels.iloc[:, 0], levels[one], "o-", color=colour, ms=4, lw=1.2, label=one)
    axis.set(
        xlabel="share within z standard deviations, normal errors",
        ylabel="share of true values",
        xlim=(0, 1),
        ylim=(0, 1),
    )
    axis.grid(visible=True, alpha=0.25)
    axis.legend(fontsize="small", loc="lower right")


def _table(case: str, name: str) -> pd.DataFrame:
    (found,) = (one for one in load_results()[case]["tables"] if one["name"] == name)
    return pd.DataFrame(found["rows"], columns=[each for each, _, _ in found["columns"]])
