"""The records: one row a view and rock, with the truth and the measures side by side."""

from dataclasses import asdict, dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.records.match import match_labels


@dataclass(frozen=True)
class RecordKey:
    """Where a row comes from; the first columns of the records."""

    experiment: str
    kind: str  # multiview, shapes, …
    series: str  # of shapes; a sweep's step; way and range of a segmentation; else empty
    scene: int
    seed: int
    view: int
    method: str  # empty for a segmentation


def join(
    place: RecordKey,
    truth: pd.DataFrame,
    instances: NDArray[np.int32],
    labels: NDArray[np.int32],
    measured: pd.DataFrame,
    *,
    min_iou: float,
) -> pd.DataFrame:
    """Set each true rock of a view beside the measured one that overlaps it.

    `measured` has one row for each number of `labels`, (rows, cols), named in its column `rock`.
    `truth` has the columns `instance` and `eligible`, and `instances` (rows, cols) shows instance
    i as i + 1. The column `status` says `matched`, `missed` (no measured partner) or `extra` (no
    true one); an extra rock is not eligible.
    """
    found = match_labels(instances, labels, min_iou=min_iou)
    partners = pd.DataFrame(
        {
            "instance": np.array([match.truth - 1 for match in found], dtype=np.int64),
            "rock": np.array([match.measured for match in found], dtype=np.int64),
            "iou": np.array([match.iou for match in found], dtype=np.float64),
        }
    )
    known = truth.astype({"instance": np.int64}).merge(partners, on="instance", how="left")
    known["status"] = np.where(known["rock"].isna(), "missed", "matched")
    extra = pd.DataFrame({"rock": measured.loc[~measured["rock"].isin(partners["rock"]), "rock"]})
    extra = extra.assign(status="extra", eligible=False)
    rows = pd.concat([known, extra], ignore_index=True).merge(measured, on="rock", how="left")
    rows["instance"] = rows["instance"].astype("Int64")
    rows["rock"] = rows["rock"].astype("Int64")
    rows["eligible"] = rows["eligible"].astype(bool)
    where = pd.DataFrame(asdict(place), index=rows.index)
    return pd.concat([where, rows], axis=1)
