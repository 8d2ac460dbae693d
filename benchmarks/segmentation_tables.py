"""The tables of docs/segmentation.md from a run of the suite `segmentation`.

`python benchmarks/segmentation_tables.py FOLDER`, the folder that `rockshape validate run` wrote.
"""

import argparse
from pathlib import Path

import numpy as np
import pandas as pd

from validation.kinds.segmentation.judge import DEPTHS_M, SIZES_PX, f1

FAMILIES = ("sparse", "crowded", "touching", "slope", "low_sun", "ripples")
WAYS = ("paper", "robust", "height", "watershed")
SOURCES = ("exact", "stereo", "sgm")


def cell(rows: pd.DataFrame) -> str:
    """F1, and mean IoU of those found."""
    if rows.empty:
        return ""
    return f"{f1(rows['status'].to_numpy()):.3f}, {rows['iou'].mean():.3f}"


def counted(rows: pd.DataFrame) -> int:
    """Rocks that count."""
    return int(rows["status"].isin(["matched", "missed"]).sum())


def of(records: pd.DataFrame, series: str, *experiments: str) -> pd.DataFrame:
    """The rows of a series in some experiments."""
    return records[(records["series"] == series) & records["experiment"].isin(experiments)]


def print_families(records: pd.DataFrame) -> None:
    """Each family from each kind of range, way by way, and all families together."""
    for source in SOURCES:
        end = "_sgm" if source == "sgm" else ""
        families = tuple(name + end for name in FAMILIES)
        print(f"| **{source}** | | | | | |")
        for names in (*((name,) for name in (*families, "imp", "cover")), families):
            rows = [of(records, f"{way}-{source}", *names) for way in WAYS]
            if rows[1].empty:
                continue
            title = names[0] if len(names) == 1 else "the six families"
            print(f"| {title} | {counted(rows[1])} | {' | '.join(cell(one) for one in rows)} |")


def print_blind(records: pd.DataFrame) -> None:
    """Without range."""
    print()
    for way in ("robust", "otsu"):
        cells = [
            cell(of(records, f"{way}-none", *names))
            for names in (*((name,) for name in (*FAMILIES, "imp")), FAMILIES)
        ]
        print(f"| {way} | {' | '.join(cells)} |")


def print_bins(records: pd.DataFrame) -> None:
    """F1 by width and by distance, all families together."""
    print()
    matched = tuple(f"{name}_sgm" for name in FAMILIES)
    for series in ("robust-exact", "robust-stereo", "robust-sgm", "robust-none"):
        rows = of(records, series, *(matched if series.endswith("sgm") else FAMILIES))
        cells = []
        for column, bins in (("width_px", SIZES_PX), ("depth_m", DEPTHS_M)):
            for low, high in bins:
                part = rows[(rows[column] >= low) & (rows[column] < high)]
                value = f1(part["status"].to_numpy())
                text = "" if np.isnan(value) else f"{value:.3f} ({counted(part)})"
                cells.append(text)
        print(f"| {series} | {' | '.join(cells)} |")


def print_rest(records: pd.DataFrame) -> None:
    """Splits and merges, the outlines' distance and the ground's error."""
    print()
    for series in sorted(records["series"].unique()):
        end = "_sgm" if series.endswith("sgm") else ""
        rows = of(records, series, *(name + end for name in FAMILIES))
        own = rows[rows["status"].isin(["matched", "missed"])]
        print(
            f"{series:16s} splits {int(own['split'].astype(bool).sum()):3d}  "
            f"merges {int(own['merged'].astype(bool).sum()):3d}  "
            f"boundary {rows['boundary_px'].median():.2f} px"
        )
    print()
    views = records.drop_duplicates(["experiment", "series", "scene", "view"])
    for (experiment, series), rows in views.groupby(["experiment", "series"], sort=False):
        if rows["ground_sigmas"].notna().any():
            print(
                f"{experiment:12s} {series:16s} ground {rows['ground_sigmas'].median():.3f} sigma, "
                f"rocks on {rows['cover'].mean():.2f} of the frame"
            )


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    records = pd.read_parquet(parser.parse_args().folder / "results.parquet")
    for part in (print_families, print_blind, print_bins, print_rest):
        part(records)


if __name__ == "__main__":
    main()
