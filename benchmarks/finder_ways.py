"""Finders held against known rocks with range and without, and what range costs the picture."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from case import Column, Table
from numpy.typing import NDArray

from rockshape.observation import Observation
from rockshape.segmentation.finders import find_finder
from validation.records.object_matching import Rule, equivalent_diameter, judge
from validation.scores.object_scores import count, f1, precision, recall

ALONE = ("network", False)
WAYS = (("image", False), ALONE, ("range", True), ("both", True))
RULE = Rule(0.5, 12.0, equivalent_diameter)


@dataclass(frozen=True, eq=False)
class KnownFrame:
    """A frame with range whose rocks are known."""

    seen: Observation
    truth: NDArray[np.int32]  # (rows, cols), 0 the ground
    counts: NDArray[np.bool_]  # (n + 1,), which of the rocks are judged


def ways_table(frames: Iterable[KnownFrame], range_name: str, *, name: str = "") -> Table:
    """Return the scores of every way over all frames together.

    `lost` are rocks that the network finds in the picture alone and the way does not.
    """
    judged: dict[tuple[str, bool], list[pd.DataFrame]] = {way: [] for way in WAYS}
    for number, frame in enumerate(frames):
        alone = replace(frame.seen, points_m=None)
        for finder, ranged in WAYS:
            found = find_finder(finder).segment(frame.seen if ranged else alone).labels
            rows = judge(frame.truth, frame.counts, found, {}, RULE)
            judged[finder, ranged].append(rows.assign(frame=number))
        print("frame", number, flush=True)
    matched = {way: _matched(parts) for way, parts in judged.items()}
    table = []
    for (finder, ranged), parts in judged.items():
        every = pd.concat(parts)["status"].to_numpy()
        counted = count(every, np.ones((1, len(every))))
        told = [float(score(counted)[0]) for score in (f1, precision, recall)]
        lost = len(matched[ALONE] - matched[finder, ranged])
        table.append((finder, range_name if ranged else "none", *told, lost))
    columns = (
        Column("finder"),
        Column("range"),
        *(Column(head, "", ".2f") for head in ("F1", "precision", "recall")),
        Column("rocks lost beside the network alone", "", "d"),
    )
    return Table(columns, table, name=name)


def _matched(parts: list[pd.DataFrame]) -> set[tuple[int, int]]:
    """Return frame and number of the rocks that were found."""
    rows = pd.concat(parts)
    found = rows[rows["status"] == "matched"]
    return set(zip(found["frame"], found["place"].astype(int), strict=True))
