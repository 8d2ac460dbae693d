"""Foreground fattening of OpenCV's block matcher, in rows and in columns, beside the model's."""

import cv2
import numpy as np
from case import Case, Column, Table
from numpy.typing import NDArray

from synth.sensor.fattening import fattened_px

Floats = NDArray[np.float64]

SIDE_PX, BLOCK = 220, slice(70, 150)  # of the picture, and the near square's rows and columns
NEAR_PX, FAR_PX = 24, 8  # disparities
_BAND_PX, _CORNER_PX = 20, 15  # looked at on both sides of an edge, away from the corners
_NOISE, _CONTRAST = 1.0, 30.0  # grey levels, RMS


def fattening(*, seeds: int = 6, first: int = 10_000) -> list[Table]:
    """Measure how far edges move for windows and contrasts of the far surface."""
    rows = []
    for window_px in (7, 11, 15):
        for share in (1.0, 0.5, 1.0 / 6.0):
            pairs = [_pair(share, np.random.default_rng(first + seed)) for seed in range(seeds)]
            found = np.mean([_moved(_matched(*pair, window_px)) for pair in pairs], axis=0)
            half_px = window_px // 2
            reach_px = round(float(found.mean()))
            model = _moved(fattened_px(_exact(), reach_px))
            rows.append((window_px, share, *found / half_px, model.mean() / half_px))
    columns = (
        Column("window", "px", "d"),
        Column("contrast, far over near", "", ".2f"),
        Column("right edge, half windows", "", ".2f"),
        Column("lower edge, half windows", "", ".2f"),
        Column("upper edge, half windows", "", ".2f"),
        Column("model, whole pixels", "", ".2f"),
    )
    return [Table(columns, rows)]


def _exact() -> Floats:
    disparity_px = np.full((SIDE_PX, SIDE_PX), float(FAR_PX))
    disparity_px[BLOCK, BLOCK] = NEAR_PX
    return disparity_px


def _pair(share: float, rng: np.random.Generator) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
    """Return left and right picture of a square before a wall of so much of its contrast."""
    wide = SIDE_PX + FAR_PX
    texture = cv2.GaussianBlur(
        rng.standard_normal((2, SIDE_PX, wide)).transpose(1, 2, 0), (0, 0), 1
    )
    texture *= _CONTRAST / texture.std()
    wall, square = 128.0 + share * texture[..., 0], 128.0 + texture[BLOCK, BLOCK, 1]
    left, right = wall[:, :SIDE_PX].copy(), wall[:, FAR_PX:].copy()
    left[BLOCK, BLOCK] = square
    right[BLOCK, BLOCK.start - NEAR_PX : BLOCK.stop - NEAR_PX] = square
    noisy = [image + _NOISE * rng.standard_normal(image.shape) for image in (left, right)]
    one, two = (np.clip(np.rint(image), 0, 255).astype(np.uint8) for image in noisy)
    return one, two


def _matched(left: NDArray[np.uint8], right: NDArray[np.uint8], window_px: int) -> Floats:
    matcher = cv2.StereoBM.create(numDisparities=48, blockSize=window_px)
    matcher.setPreFilterType(cv2.STEREO_BM_PREFILTER_NORMALIZED_RESPONSE)
    matcher.setTextureThreshold(0)
    matcher.setUniquenessRatio(0)
    return np.asarray(matcher.compute(left, right) / 16.0)


def _moved(disparity_px: Floats) -> Floats:
    """Return how far the square reaches over its right, lower and upper edge, px.

    Beyond its left edge the right eye does not see the wall: what is found there is no fattening.
    """
    middle = 0.5 * (NEAR_PX + FAR_PX)
    near = (disparity_px > middle).astype(float)
    inner = slice(BLOCK.start + _CORNER_PX, BLOCK.stop - _CORNER_PX)
    at_stop = slice(BLOCK.stop - _BAND_PX, BLOCK.stop + _BAND_PX)
    at_start = slice(BLOCK.start - _BAND_PX, BLOCK.start + _BAND_PX)
    bands = near[inner, at_stop].T, near[at_stop, inner], near[at_start, inner]
    return np.array([band.mean(axis=1).sum() - _BAND_PX for band in bands])


FATTENING_CASE = Case(
    name="fattening",
    what="edges of a textured square moved by OpenCV's StereoBM, in rows and in columns",
    run=fattening,
    smallest={"seeds": 1, "first": 0},
)
