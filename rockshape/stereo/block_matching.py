"""Semi-global block matching of two rectified pictures, by OpenCV."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.numerics.arrays import Floats

Bytes = NDArray[np.uint8]

SUBSTEPS = 16  # OpenCV's disparities are in sixteenths of a pixel
GRANULE = 16  # px, of which the number of disparities is a multiple
BLOCK_PX = 5  # side of the window whose differences are summed
SMALL_PENALTY, LARGE_PENALTY = 8, 32  # a pixel of the window, as OpenCV's manual has them for grey
MAX_LEFT_RIGHT_PX = 1  # by which the two directions of matching may differ
UNIQUENESS_PERCENT = 5  # by which the best cost must beat the second
SPECKLE_PX, SPECKLE_STEP_PX = 100, 1  # smaller regions that such a step cuts off are no match
COST_BYTES = 4  # of memory, a pixel and disparity
BAND_BYTES = 2**28  # of the costs of a band of rows
MAX_BAND_BYTES = 3 * 2**28  # of those of the least band with its overlaps
OVERLAP_ROWS = 32  # of the bands that are matched one after the other
COARSE_COLS = 320  # px, of the pictures in which the search range is looked for
FAR_NEAR_PERCENT = (0.2, 99.8)  # of the coarse disparities, the ends of the search range
SEARCH_MARGIN = 0.15  # of the coarse disparities' range, on either side
MIN_MARGIN_PX = 4


@dataclass(frozen=True)
class SearchRange:
    """Disparities that are tried, px: from the least on, a multiple of 16 of them."""

    least: int
    count: int


def search_between(low: float, high: float) -> SearchRange:
    """Search range that holds all disparities from low to high, px."""
    least = int(np.floor(low))
    count = max(1, int(np.ceil(high)) + 1 - least)
    return SearchRange(least, GRANULE * -(-count // GRANULE))


def matched_disparity(left: Bytes, right: Bytes, search: SearchRange) -> Floats:
    """Disparity (rows, cols), px, column in the left picture less that in the right; NaN: no match.

    A match is unique, is found from either picture, ends within the right one and is no speckle.
    Rows are matched in bands where the whole needs too much memory.
    Raises: InputError where even a band needs more than 0.8 GB.
    Source: Hirschmüller (2008), equations 11 to 15, in eight directions; OpenCV's StereoSGBM.
    """
    rows, cols = left.shape
    matcher = cv2.StereoSGBM.create(
        minDisparity=search.least,
        numDisparities=search.count,
        blockSize=BLOCK_PX,
        P1=SMALL_PENALTY * BLOCK_PX**2,
        P2=LARGE_PENALTY * BLOCK_PX**2,
        disp12MaxDiff=MAX_LEFT_RIGHT_PX,
        uniquenessRatio=UNIQUENESS_PERCENT,
        speckleWindowSize=SPECKLE_PX,
        speckleRange=SPECKLE_STEP_PX,
        mode=cv2.StereoSGBM_MODE_HH,
    )
    # OpenCV gives no disparity to columns whose search leaves the right picture
    before, after = max(0, search.least + search.count), max(0, -search.least)
    row_bytes = COST_BYTES * (before + cols + after) * search.count
    if 3 * OVERLAP_ROWS * row_bytes > MAX_BAND_BYTES:
        raise InputError(
            f"stereo pair: expected pictures whose matching needs at most 0.8 GB, found {cols} "
            f"columns and {search.count} disparities; reduce both pictures"
        )
    band = max(OVERLAP_ROWS, BAND_BYTES // row_bytes)
    steps = np.empty((rows, cols), dtype=np.int16)
    for start in range(0, rows, band):
        first, stop = max(0, start - OVERLAP_ROWS), min(rows, start + band)
        padded = [
            cv2.copyMakeBorder(
                each[first : stop + OVERLAP_ROWS], 0, 0, before, after, cv2.BORDER_REPLICATE
            )
            for each in (left, right)
        ]
        found = np.asarray(matcher.compute(padded[0], padded[1]))
        steps[start:stop] = found[start - first : stop - first, before : before + cols]
    disparity = _unbiased(steps) / SUBSTEPS
    partner = np.arange(cols) - disparity
    matched = (steps >= SUBSTEPS * search.least) & (partner >= -0.5) & (partner <= cols - 0.5)
    return np.where(matched, disparity, np.nan)


def _unbiased(steps: NDArray[np.int16]) -> Floats:
    """Sixteenths rounded to the nearest, where OpenCV rounds up those below a whole disparity.

    It adds a half to the offset from the whole disparity and drops the fraction, so that what is
    below the whole comes out one sixteenth too great, and 0 gathers offsets from -1.5 to 0.5.
    """
    part = steps % SUBSTEPS
    excess = np.select([part == 0, part > SUBSTEPS // 2], [0.5, 1.0])
    return np.asarray(steps - excess)


def coarse_disparity(left: Bytes, right: Bytes, *, infinity_px: float) -> Floats:
    """Disparity of reduced pictures, px of the whole ones, searched over half their width.

    infinity_px is the disparity of what is infinitely far, below which there is none.
    """
    rows, cols = left.shape
    scale = min(1.0, COARSE_COLS / cols)
    size = max(1, round(cols * scale)), max(1, round(rows * scale))
    far = infinity_px * scale
    found = matched_disparity(
        _reduced(left, size), _reduced(right, size), search_between(far - 1, far + size[0] / 2)
    )
    return np.asarray(found / scale)


def search_around(coarse: Floats, *, infinity_px: float) -> SearchRange:
    """Search range of a coarse disparity and a margin; it has a match."""
    low, high = np.nanpercentile(coarse, FAR_NEAR_PERCENT)
    margin = SEARCH_MARGIN * (high - low) + MIN_MARGIN_PX
    return search_between(max(infinity_px - 1, low - margin), high + margin)


def _reduced(picture: Bytes, size: tuple[int, int]) -> Bytes:
    return np.asarray(cv2.resize(picture, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
