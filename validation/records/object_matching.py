"""One label image held against the true one: what was found, missed, split and merged."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pandas as pd
import scipy.ndimage as ndi
from numpy.typing import NDArray
from scipy.spatial import cKDTree
from skimage.measure import find_contours

from validation.arrays import Floats, Labels
from validation.errors import InputError

SPLIT_SHARE = 0.2  # of a true rock in each of two found ones: split
MERGED_SHARE = 0.5  # of each of two true rocks in one found: merged
IGNORED_SHARE = 0.5  # of a found rock on true ones that do not count: it does not count either
_COLUMNS = (
    "instance",
    "status",
    "found",
    "iou",
    "width_px",
    "boundary_px",
    "split",
    "merged",
    "place",
)
_KINDS = {
    "instance": "Int64",
    "found": "Int64",
    "width_px": "float64",
    "split": "boolean",
    "merged": "boolean",
}


def columns(mask: NDArray[np.bool_]) -> float:
    """Columns that a mask (rows, cols) within its window spans."""
    return float(mask.shape[1])


def equivalent_diameter(mask: NDArray[np.bool_]) -> float:
    """Diameter of the disk that has as many pixels as a mask, 2 √(A/π)."""
    return float(2 * np.sqrt(np.count_nonzero(mask) / np.pi))


def whole_and_wide(labels: Labels, least_px: float) -> NDArray[np.bool_]:
    """Which labels (n + 1,) the frame does not cut and are as wide as a disk of a diameter."""
    counts = 2 * np.sqrt(np.bincount(labels.ravel()) / np.pi) >= least_px
    for border in (labels[0], labels[-1], labels[:, 0], labels[:, -1]):
        counts[border] = False
    counts[0] = False
    return np.asarray(counts)


@dataclass(frozen=True)
class Rule:
    """Which rocks count."""

    min_iou: float
    min_width_px: float
    width: Callable[[NDArray[np.bool_]], float] = columns  # of a mask within its window


def judge(
    truth: Labels,
    eligible: NDArray[np.bool_],
    found: Labels,
    outlines: dict[int, Floats],
    rule: Rule,
) -> pd.DataFrame:
    """One row for each true rock that counts and for each found one that is no true rock.

    truth and found are (rows, cols), 0 the ground; eligible (n + 1,) tells which true numbers
    count. `status` is `matched` (IoU above min_iou, at which a partner is the only one), `missed`
    or `extra`. As COCO has it, a found rock that matches a true one which does not count, lies on
    such by half, is under the least width or touches the frame's border is neither right nor wrong
    and has no row. `found` is the found rock's number, `place` the true one's, or for an extra one
    minus its own. `boundary_px` is the median distance between the outlines, both ways; `split`
    and `merged` say whether two found rocks hold a fifth of the true one each, and whether a found
    rock that holds half of it holds half of another.

    Raises:
        InputError: the shapes differ.
    """
    if truth.shape != found.shape:
        raise InputError(f"labels: expected {truth.shape} as the truth, found {found.shape}")
    count, others = len(eligible), int(found.max(initial=0)) + 1
    common = np.bincount(
        truth.ravel().astype(np.intp) * others + found.ravel(), minlength=count * others
    ).reshape(count, others)
    true_px, found_px = common.sum(axis=1), common.sum(axis=0)
    iou = common / np.maximum(true_px[:, None] + found_px - common, 1)
    iou[0], iou[:, 0] = 0, 0
    merged_in = ((common[1:] > MERGED_SHARE * true_px[1:, None]) & (true_px[1:, None] > 0)).sum(
        axis=0
    )
    rows = []
    for number, window in enumerate(ndi.find_objects(truth), start=1):
        if window is None or not eligible[number]:
            continue
        partner = int(iou[number].argmax())
        matched = iou[number, partner] > rule.min_iou
        holders = common[number, 1:]
        rows.append(
            {
                "instance": number - 1,
                "status": "matched" if matched else "missed",
                "found": partner if matched else pd.NA,
                "iou": iou[number, partner] if matched else np.nan,
                "width_px": rule.width(truth[window] == number),
                "boundary_px": _boundary_px(truth, number, found, partner, outlines)
                if matched
                else np.nan,
                "split": bool((holders > SPLIT_SHARE * true_px[number]).sum() > 1),
                "merged": bool(
                    ((holders > MERGED_SHARE * true_px[number]) & (merged_in[1:] > 1)).any()
                ),
                "place": number,
            }
        )
    free = ~eligible
    free[0] = False
    for number, window in enumerate(ndi.find_objects(found), start=1):
        if window is None or iou[:, number].max() > rule.min_iou:
            continue
        width = rule.width(found[window] == number)
        ignored = common[free, number].sum() >= IGNORED_SHARE * found_px[number]
        if ignored or width < rule.min_width_px or _on_border(window, truth.shape):
            continue
        rows.append({"status": "extra", "found": number, "width_px": width, "place": -number})
    return pd.DataFrame(rows, columns=list(_COLUMNS)).astype(_KINDS)


def _on_border(window: tuple[slice, slice], shape: tuple[int, ...]) -> bool:
    return any(
        side.start == 0 or side.stop == size for side, size in zip(window, shape, strict=True)
    )


def _boundary_px(
    truth: Labels, number: int, found: Labels, partner: int, outlines: dict[int, Floats]
) -> float:
    true_ring = _ring(truth == number)
    ring = outlines[partner] if partner in outlines else _ring(found == partner)
    there, back = cKDTree(true_ring).query(ring)[0], cKDTree(ring).query(true_ring)[0]
    return float(np.median(np.concatenate([there, back])))


def _ring(mask: NDArray[np.bool_]) -> Floats:
    """The mask's longest border, (n, 2) as (x, y), half way between the pixels' centres."""
    rows, cols = np.nonzero(mask)
    top, left = int(rows.min()), int(cols.min())
    part = mask[top : rows.max() + 1, left : cols.max() + 1]
    rings = find_contours(np.pad(part, 1).astype(np.float64), 0.5)
    return np.asarray(max(rings, key=len)[:, ::-1] + (left - 1, top - 1))
