"""Chart of docs/findings.md: what each cause has in the variance of each measure."""

from pathlib import Path

import matplotlib as mpl
import numpy as np
from cases.studies import CAUSES, scores_by_measure

from rockshape.method import methods

mpl.use("Agg")
from matplotlib import pyplot as plt

# Okabe and Ito's colours, told apart by the colour-blind; the hatches tell them apart in grey.
STYLES = {
    "view": ("#0072B2", ""),
    "distance": ("#56B4E9", "//"),
    "light": ("#F0E442", ".."),
    "noise": ("#D55E00", "xx"),
    "segmentation": ("#E69F00", "\\\\"),
    "rest": ("#999999", "--"),
}


def draw(folder: Path) -> None:
    """Write findings.png: a stacked bar a measure; what is negative goes to the left."""
    scores = scores_by_measure(jobs=2)
    mpl.rcParams["hatch.linewidth"] = 0.6
    figure, axes = plt.subplots(1, 2, figsize=(11.5, 5.2), sharex=True, layout="constrained")
    for axis, method in zip(axes, ("paper", "robust"), strict=True):
        columns = [measure.column for measure in methods()[method].measures]
        own = [scores[method, column] for column in columns]
        places = -np.arange(len(columns))
        right, left = np.zeros(len(columns)), np.zeros(len(columns))
        for cause, (colour, hatch) in STYLES.items():
            shares = 100.0 * np.array([one[f"share_{cause}"].value for one in own])
            widths = np.nan_to_num(shares)
            axis.barh(
                places,
                widths,
                left=np.where(widths >= 0, right, left),
                color=colour,
                hatch=hatch,
                edgecolor="#333333",
                linewidth=0.4,
                label=CAUSES[cause],
            )
            right += np.maximum(widths, 0)
            left += np.minimum(widths, 0)
        labels = []
        for column, one in zip(columns, own, strict=True):
            cv = one["cv"].value
            moved = f"CV {100 * cv:.0f} %" if np.isfinite(cv) else "refused in the noise"
            labels.append(f"{column}\n{moved}")
        axis.set_yticks(places, labels, fontsize=9)
        axis.axvline(0, color="#333333", linewidth=0.8)
        axis.set_title(f"--method {method}", fontsize=11)
        axis.set_xlabel("share of the variance that a user sees, %")
        axis.spines[["top", "right"]].set_visible(False)
    handles, names = axes[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside upper center", ncols=len(STYLES), frameon=False)
    figure.savefig(folder / "findings.png", dpi=110, facecolor="white")
    plt.close(figure)
