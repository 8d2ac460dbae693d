"""Which measured rock is which true one: one to one, by the overlap of their label masks."""

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.errors import InputError


@dataclass(frozen=True)
class Match:
    """A true label, the measured label that stands for it, and their intersection over union."""

    truth: int
    measured: int
    iou: float


def match_labels(
    truth: NDArray[np.int32], measured: NDArray[np.int32], *, min_iou: float
) -> tuple[Match, ...]:
    """Match true and measured labels so that the sum of overlaps is greatest (Kuhn 1955).

    Both are (rows, cols), 0 the background. IoU = |T ∩ M|/|T ∪ M|; couples under `min_iou` are no
    match and do not compete with the others. Above one half at most one partner is possible.

    Raises:
        InputError: the shapes differ.
    """
    # imported when first called: it takes half a second, and what only names records needs none
    from scipy.optimize import linear_sum_assignment  # noqa: PLC0415

    if truth.shape != measured.shape:
        raise InputError(f"labels: expected {truth.shape} as the truth, found {measured.shape}")
    true_index, true_ids = pd.factorize(truth.ravel(), sort=True)
    found_index, found_ids = pd.factorize(measured.ravel(), sort=True)
    shape = (true_ids.size, found_ids.size)
    flat = true_index * found_ids.size + found_index
    common = np.bincount(flat, minlength=shape[0] * shape[1]).reshape(shape)
    union = common.sum(axis=1, keepdims=True) + common.sum(axis=0) - common
    iou = common / union
    iou[true_ids == 0, :] = 0.0
    iou[:, found_ids == 0] = 0.0
    iou[iou < min_iou] = 0.0
    rows, cols = linear_sum_assignment(iou, maximize=True)
    return tuple(
        Match(truth=int(true_ids[r]), measured=int(found_ids[c]), iou=float(iou[r, c]))
        for r, c in zip(rows, cols, strict=True)
        if iou[r, c] > 0
    )
