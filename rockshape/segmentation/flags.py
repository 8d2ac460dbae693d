"""What a rock's view lacks: cut off, hidden, buried, small or in shadow."""

import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray

from rockshape.rock.visibility import touches_border
from rockshape.segmentation.by_range.height_signal import HeightSignal

SMALL_PX = 12  # a rock narrower than this has no outline worth measuring
HIDDEN_SHARE = 0.1  # of a rock's border along which a nearer rock stands
DARK = 0.45  # of the ground's brightness: in shadow
SHADOWED_SHARE = 0.6  # of a rock's pixels
FOOT_SHARE = 0.15  # of a rock's height: its foot
BURIED_WIDTH = 0.97  # of a rock's width, that its foot has: it does not turn in below
CLEAR_SIGMA = 10.0  # a rock's height in the ground's noise before its foot can be seen
STEPS = ((0, 1), (1, 0))


def flag(
    image: NDArray[np.float32],
    labels: NDArray[np.int32],
    relief: HeightSignal | None,
    *,
    frame: tuple[slice, slice],
) -> dict[int, tuple[str, ...]]:
    """Flags of each label (rows, cols) by its number.

    `truncated`: touches the border of the frame, or of its measured part. `occluded`: a nearer
    rock stands along a tenth of its border. `buried`: as wide at its foot, the lowest 15 % of its
    height, as anywhere, so that it goes on below the ground; told only of rocks 10 standard
    deviations high. `small`: less than 12 pixels wide or high. `shadowed`: 60 % of its pixels are
    darker than 45 % of the ground's median.
    """
    every_other = np.s_[::2, ::2]
    bare = image[every_other][labels[every_other] == 0]
    dark = image < DARK * (float(np.median(bare)) if bare.size else 1.0)
    hidden = _hidden_share(labels, relief)
    told = {}
    for number, window in enumerate(ndi.find_objects(labels), start=1):
        if window is None:
            continue
        mask = labels[window] == number
        names = []
        if touches_border(window, frame) or touches_border(window, _whole(labels)):
            names.append("truncated")
        if hidden[number] >= HIDDEN_SHARE:
            names.append("occluded")
        if relief is not None and _is_buried(relief, window, mask):
            names.append("buried")
        if min(mask.shape) < SMALL_PX:
            names.append("small")
        if dark[window][mask].mean() >= SHADOWED_SHARE:
            names.append("shadowed")
        told[number] = tuple(names)
    return told


def _whole(labels: NDArray[np.int32]) -> tuple[slice, slice]:
    return slice(0, labels.shape[0]), slice(0, labels.shape[1])


def _hidden_share(labels: NDArray[np.int32], relief: HeightSignal | None) -> NDArray[np.float64]:
    """Share of each label's border along which a nearer one lies; 0 without range."""
    count = int(labels.max(initial=0)) + 1
    border = np.zeros(count)
    hidden = np.zeros(count)
    if relief is None:
        return hidden
    known = relief.known & (labels > 0)
    total = np.bincount(labels[known], relief.depth_m[known], minlength=count)
    depth = total / np.maximum(np.bincount(labels[known], minlength=count), 1)
    depth[0] = np.inf  # ground in front of a rock does not hide it
    depth[depth == 0] = np.inf
    for down, right in STEPS:
        one = labels[: labels.shape[0] - down, : labels.shape[1] - right]
        two = labels[down:, right:]
        apart = one != two
        for mine, theirs in ((one[apart], two[apart]), (two[apart], one[apart])):
            border += np.bincount(mine, minlength=count)
            nearer = (theirs > 0) & (depth[theirs] < depth[mine])
            hidden += np.bincount(mine, nearer, minlength=count)
    return np.asarray(hidden / np.maximum(border, 1))


def _is_buried(relief: HeightSignal, window: tuple[slice, slice], mask: NDArray[np.bool_]) -> bool:
    height = np.where(mask & relief.known[window], relief.height_m[window], 0)
    top = float(height.max())
    if top < CLEAR_SIGMA * float(np.median(relief.sigma_m[window][mask])):
        return False
    widths = [
        np.ptp(np.flatnonzero(part.any(axis=0))) + 1 if part.any() else 0
        for part in (
            mask & (height > 0) & (height <= FOOT_SHARE * top),
            mask & (height > FOOT_SHARE * top),
        )
    ]
    return bool(widths[0] >= BURIED_WIDTH * widths[1] > 0)
