"""Regions that stand on the ground cut into rocks: by valleys and by jumps of depth.

Each pixel climbs to its highest neighbour, so that every top gathers a region of its own (the
watershed by hill climbing, Meyer 1994). Regions are then merged: bumps first, then tops that
neither a valley nor a jump of depth parts.
"""

from dataclasses import dataclass

import cv2
import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray

from rockshape.numerics.arrays import Floats, Mask, Singles
from rockshape.segmentation.by_range.height_signal import HeightSignal

Whole = NDArray[np.intp]

BUMP_SIGMA = 4.0  # a top stands this many standard deviations above its saddle, or is a bump
BUMP_SHARE = 0.1  # and this share of its own height
VALLEY_SHARE = 0.25  # a valley as deep as this share of the lower top's height parts two rocks
JUMP_SIGMA = 5.0  # neighbours this many standard deviations of depth apart are on two surfaces,
JUMP_PIXELS = 8.0  # if they are also this many pixels' sizes apart: a slope of 83 degrees
JUMP_SHARE = 0.5  # of a common border that jumps: two rocks
FLATTEST = 0.08  # a rock's height over its width,
FLATTEST_ON_WAVES = 0.16  # and where the ground undulates, which leaves crests behind
SMOOTH_PX = 5
STEPS = ((0, 1), (1, 0), (1, 1), (1, -1))


@dataclass(frozen=True, eq=False)
class _Links:
    """Pairs of neighbouring pixels of the mask, numbered in reading order of the mask's pixels."""

    first: Whole  # (m,)
    second: Whole  # (m,)
    jumps: Mask  # (m,)


@dataclass(frozen=True, eq=False)
class _Borders:
    """Common borders of regions, the highest saddle first."""

    first: Whole  # (b,), region
    second: Whole  # (b,), region
    saddle: Floats  # (b,), the highest pass between them
    jumps: Floats  # (b,), share of the border's links that jump


def split(relief: HeightSignal, mask: Mask, *, flattest: float) -> NDArray[np.int32]:
    """Labels (rows, cols) from 1 of the rocks in a mask of what stands on the ground.

    Heights are smoothed by a median over 5 pixels. Two tops are one where the lower one stands less
    than 4 standard deviations or a tenth of its height above the saddle between them and the way
    over it does not jump; of what is left, two are one unless the valley is as deep as a quarter of
    the lower one's height or half of the common border jumps in depth. Regions under five pixels
    wide, which noise leaves along steep sides, go to the neighbour with the longest common border;
    those less than `flattest` as high as wide are swellings of the ground and dropped.
    """
    pixels = np.flatnonzero(mask)
    labels = np.zeros(mask.shape, dtype=np.int32)
    if len(pixels) == 0:
        return labels
    smooth = np.asarray(cv2.medianBlur(relief.height_m, SMOOTH_PX), dtype=np.float32)
    height = smooth.ravel()[pixels]
    sigma = relief.sigma_m.ravel()[pixels]
    links = _link(relief, mask, pixels)
    order = np.argsort(height, kind="stable")
    _, region = np.unique(_climb(order, links), return_inverse=True)
    for share in (BUMP_SHARE, VALLEY_SHARE):
        peak, noise = _peaks(region, height, sigma, order)
        rise = np.maximum(BUMP_SIGMA * noise, share * peak)
        region = _merge(region, _borders(region, height, links), peak, rise)
    region = _without_slivers(region, links, mask, pixels)
    labels.ravel()[pixels] = region + 1
    return _without_flat(labels, relief, flattest)


def _link(relief: HeightSignal, mask: Mask, pixels: Whole) -> _Links:
    """Neighbours within the mask, 8-connected, and whether the depth jumps between them."""
    cols = mask.shape[1] + 2
    number = np.full((mask.shape[0] + 2, cols), -1, dtype=np.intp)
    number[1:-1, 1:-1][mask] = np.arange(len(pixels))
    number = number.ravel()
    row, col = np.divmod(pixels, mask.shape[1])
    place = (row + 1) * cols + col + 1
    depth = cv2.medianBlur(relief.depth_m, 3).ravel()[pixels]
    depth = np.where(relief.known.ravel()[pixels], depth, np.float32(np.nan))
    limit = np.maximum(
        JUMP_SIGMA * relief.depth_sd_m.ravel()[pixels], JUMP_PIXELS * relief.pixel_rad * depth
    )
    first, second = [], []
    for down, right in STEPS:
        neighbour = number[place + down * cols + right]
        there = neighbour >= 0
        first.append(np.flatnonzero(there))
        second.append(neighbour[there])
    one, two = np.concatenate(first), np.concatenate(second)
    return _Links(one, two, np.abs(depth[two] - depth[one]) > limit[one])


def _climb(order: Whole, links: _Links) -> Whole:
    """The top that each pixel reaches by its highest neighbours, as the top's pixel number.

    order (n,) has the pixels from the lowest to the highest; links that jump are no way up.
    """
    rank = np.empty(len(order), dtype=np.intp)
    rank[order] = np.arange(len(order))
    free = ~links.jumps
    first, second = links.first[free], links.second[free]
    best = rank.copy()
    np.maximum.at(best, first, rank[second])
    np.maximum.at(best, second, rank[first])
    up = order[best]
    while True:
        further = up[up]
        if np.array_equal(further, up):
            return up
        up = further


def _peaks(region: Whole, height: Singles, sigma: Singles, order: Whole) -> tuple[Floats, Floats]:
    """Each region's greatest height, and the noise there."""
    top = np.empty(int(region.max()) + 1, dtype=np.intp)
    top[region[order]] = order  # the last, the highest, stays
    return height[top].astype(np.float64), sigma[top].astype(np.float64)


def _borders(region: Whole, height: Singles, links: _Links) -> _Borders:
    one, two = region[links.first], region[links.second]
    apart = np.flatnonzero(one != two)
    one, two = one[apart], two[apart]
    saddle = np.minimum(height[links.first[apart]], height[links.second[apart]])
    key = np.minimum(one, two) * (int(region.max()) + 1) + np.maximum(one, two)
    order = np.lexsort((saddle, key))
    ends = np.flatnonzero(np.diff(key[order], append=-1))
    starts = np.concatenate([[0], ends[:-1] + 1]).astype(np.intp)[: len(ends)]
    total = np.concatenate([[0], np.cumsum(links.jumps[apart][order])])
    share = (total[ends + 1] - total[starts]) / (ends - starts + 1)
    highest = order[ends]
    down = np.argsort(-saddle[highest], kind="stable")
    last = highest[down]
    return _Borders(one[last], two[last], saddle[last].astype(np.float64), share[down])


def _merge(region: Whole, borders: _Borders, peak: Floats, rise: Floats) -> Whole:
    """Regions merged over their borders, the highest saddle first, numbered from 0.

    The lower of two tops is part of the higher where it stands less than `rise` (r,) above their
    saddle and less than half of their border jumps.
    """
    parent = list(range(len(peak)))

    def root(number: int) -> int:
        while parent[number] != number:
            parent[number] = parent[parent[number]]
            number = parent[number]
        return number

    joined = borders.jumps < JUMP_SHARE
    for one, two, saddle in zip(
        borders.first[joined].tolist(),
        borders.second[joined].tolist(),
        borders.saddle[joined].tolist(),
        strict=True,
    ):
        high, low = root(one), root(two)
        if high == low:
            continue
        if peak[high] < peak[low]:
            high, low = low, high
        if peak[low] - saddle < rise[low]:
            parent[low] = high
    roots = np.array([root(number) for number in range(len(peak))])
    _, merged = np.unique(roots, return_inverse=True)
    return np.asarray(merged[region], dtype=np.intp)


def _without_slivers(region: Whole, links: _Links, mask: Mask, pixels: Whole) -> Whole:
    """Regions under five pixels wide given to a neighbour; -1 where there is none to take them."""
    one, two = region[links.first], region[links.second]
    apart = np.flatnonzero(one != two)
    inner = mask.astype(np.uint8)
    inner.ravel()[pixels[links.first[apart]]] = 0
    inner.ravel()[pixels[links.second[apart]]] = 0
    deep = np.minimum(
        cv2.erode(inner, np.ones((3, 3), np.uint8)),
        cv2.erode(mask.astype(np.uint8), np.ones((5, 5), np.uint8)),
    )
    wide = np.zeros(int(region.max()) + 1, dtype=bool)
    wide[region[deep.ravel()[pixels] > 0]] = True
    home = np.where(wide, np.arange(len(wide)), -1)
    one, two = one[apart], two[apart]
    thin = np.concatenate([one[~wide[one] & wide[two]], two[~wide[two] & wide[one]]])
    taker = np.concatenate([two[~wide[one] & wide[two]], one[~wide[two] & wide[one]]])
    pairs, count = np.unique(np.column_stack([thin, taker]), axis=0, return_counts=True)
    longest_last = np.argsort(count, kind="stable")
    home[pairs[longest_last, 0]] = pairs[longest_last, 1]
    return home[region]


def _without_flat(
    labels: NDArray[np.int32], relief: HeightSignal, flattest: float
) -> NDArray[np.int32]:
    """Labels without regions less than `flattest` as high as they are wide."""
    keep = np.zeros(int(labels.max()) + 1, dtype=bool)
    for number, window in enumerate(ndi.find_objects(labels), start=1):
        if window is None:
            continue
        own = (labels[window] == number) & relief.known[window]
        if own.any():
            width = (window[1].stop - window[1].start) * relief.pixel_rad
            width *= float(relief.depth_m[window][own].mean())
            keep[number] = float(relief.height_m[window][own].max()) >= flattest * width
    return np.where(keep[labels], labels, 0)
