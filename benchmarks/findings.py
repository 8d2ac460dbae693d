"""Why values move between views: the table and the chart of docs/findings.md, from a run.

rockshape validate run --suite views --out reports/views
python benchmarks/findings.py reports/views --plot docs/images/findings.png
"""

import argparse
import json
import math
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

mpl.use("Agg")

import matplotlib.pyplot as plt

from rockshape.method import methods

CAUSES = ("view", "distance", "light", "noise", "segmentation", "rest")
NAMES = {
    "view": "view",
    "distance": "distance",
    "light": "light",
    "noise": "range noise",
    "segmentation": "segmentation",
    "rest": "pixel grid",
}
# Okabe and Ito's colours, told apart by the colour-blind; the hatches tell them apart in grey.
COLOURS = {
    "view": "#0072B2",
    "distance": "#56B4E9",
    "light": "#F0E442",
    "noise": "#D55E00",
    "segmentation": "#E69F00",
    "rest": "#999999",
}
HATCHES = {
    "view": "",
    "distance": "//",
    "light": "..",
    "noise": "xx",
    "segmentation": "\\\\",
    "rest": "--",
}
EXPERIMENT = "views"


def scores_of(folder: Path) -> dict[str, dict[str, Any]]:
    """Return the scores of a run by name."""
    document = json.loads((folder / "scores.json").read_text(encoding="utf-8"))
    return {score["name"]: score for score in document["scores"]}


def columns() -> list[tuple[str, str, str]]:
    """Return (method, column, start of the scores' names) of every measure."""
    return [
        (method, m.column, f"{EXPERIMENT}.{'' if method == 'paper' else method + '.'}{m.column}.")
        for method, record in methods().items()
        for m in record.measures
    ]


def cell(score: dict[str, Any] | None, *, percent: bool = True) -> str:
    """Return a score with its interval, as a table's cell."""
    if score is None or score["value"] is None:
        return "–"
    factor, digits = (100.0, 0) if percent else (1.0, 2)
    texts = [
        f"{factor * score[key]:.{digits}f}" if score[key] is not None else "–"
        for key in ("value", "low", "high")
    ]
    return f"{texts[0]} ({texts[1]}…{texts[2]})".replace("-", "−")


def print_tables(scores: dict[str, dict[str, Any]]) -> None:
    """Print the shares, then what was measured and how far orders hold, as Markdown."""
    heads = (
        "method",
        "measure",
        "CV clean, %",
        "CV, %",
        *(NAMES[c] for c in CAUSES),
        "true share of view",
        "rocks",
    )
    print("| " + " | ".join(heads) + " |\n|" + " --- |" * len(heads))
    for method, column, start in columns():
        row = [cell(scores[start + name]) for name in ("cv_clean", "cv")]
        row += [cell(scores[f"{start}share_{cause}"]) for cause in CAUSES]
        row += [cell(scores.get(start + "true_share")), str(scores[start + "cv"]["count"])]
        print(f"| {method} | `{column}` | " + " | ".join(row) + " |")
    heads = (
        "method",
        "measure",
        "clean",
        "found",
        "noisy",
        "shared, clean",
        "noisy",
        "τ_b of two frames, clean",
        "noisy",
        "one frame",
        "two frames",
    )
    print("\n| " + " | ".join(heads) + " |\n|" + " --- |" * len(heads))
    for method, column, start in columns():
        row = [cell(scores[f"{start}measured_{state}"]) for state in ("clean", "found", "noisy")]
        row += [cell(scores[start + name]) for name in ("shared_clean", "shared")]
        row += [
            cell(scores[start + name], percent=False) for name in ("tau_frames_clean", "tau_frames")
        ]
        row += [cell(scores[start + name]) for name in ("order_within", "order_across")]
        print(f"| {method} | `{column}` | " + " | ".join(row) + " |")


def print_clean(scores: dict[str, dict[str, Any]]) -> None:
    """Print what moves the clean values: their three parts over the sum of these."""
    causes = ("view", "distance", "rest")
    print("\n| method | measure | " + " | ".join(NAMES[c] for c in causes) + " |")
    print("|" + " --- |" * (2 + len(causes)))
    for method, column, start in columns():
        shares = [scores[f"{start}share_{cause}"]["value"] for cause in causes]
        if None not in shares:
            texts = [f"{100.0 * share / sum(shares):.0f}".replace("-", "−") for share in shares]
            print(f"| {method} | `{column}` | " + " | ".join(texts) + " |")


def draw(scores: dict[str, dict[str, Any]], path: Path) -> None:
    """Draw each measure's variance as a stacked bar; what is negative goes to the left."""
    mpl.rcParams["hatch.linewidth"] = 0.6
    figure, axes = plt.subplots(1, 2, figsize=(11.5, 5.2), sharex=True, layout="constrained")
    for axis, (method, record) in zip(axes, methods().items(), strict=True):
        measures = record.measures
        starts = [start for own, _, start in columns() if own == method]
        places = np.arange(len(measures))[::-1]
        right, left = np.zeros(len(measures)), np.zeros(len(measures))
        for cause in CAUSES:
            values = [scores[f"{start}share_{cause}"]["value"] for start in starts]
            shares = 100.0 * np.array([math.nan if v is None else v for v in values])
            widths = np.nan_to_num(shares)
            base = np.where(widths >= 0, right, left)
            axis.barh(
                places,
                widths,
                left=base,
                color=COLOURS[cause],
                hatch=HATCHES[cause],
                edgecolor="#333333",
                linewidth=0.4,
                label=NAMES[cause],
            )
            right += np.maximum(widths, 0)
            left += np.minimum(widths, 0)
        labels = []
        for measure, start in zip(measures, starts, strict=True):
            cv = scores[start + "cv"]["value"]
            moved = "refused in the noise" if cv is None else f"moves by {100 * cv:.0f} %"
            labels.append(f"{measure.column}\n{moved}")
        axis.set_yticks(places, labels, fontsize=9)
        axis.axvline(0, color="#333333", linewidth=0.8)
        axis.set_title(f"--method {method}", fontsize=11)
        axis.set_xlabel("share of the variance that a user sees, %")
        axis.spines[["top", "right"]].set_visible(False)
    handles, names = axes[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside upper center", ncols=len(CAUSES), frameon=False)
    figure.savefig(path, dpi=110, facecolor="white")


def main() -> None:
    """Print the tables and draw the chart."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", type=Path, help="folder of a run of suite `views`")
    parser.add_argument("--plot", type=Path, help="PNG to draw")
    args = parser.parse_args()
    scores = scores_of(args.run)
    print_tables(scores)
    print_clean(scores)
    if args.plot:
        draw(scores, args.plot)


if __name__ == "__main__":
    main()
