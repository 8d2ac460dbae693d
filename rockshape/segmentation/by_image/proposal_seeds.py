"""Where a rock may be: what is unlike the ground and no cast shadow, its cores and its facets."""

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Floats, Singles
from rockshape.numerics.strips import by_strips
from rockshape.segmentation.by_image.ground_appearance import LIT, SHADED, Lightness

MIN_PIXELS = 60
DEPTHS_PX = (3, 6, 10, 16, 24)  # cores: what lies so deep within the border,
MIN_IN_CORE = 18
FACET_EDGE = 4.0  # facets: what edges of so many deviations of the texture per pixel enclose,
MIN_IN_FACET = 25
FACET_RIM_PX = 1.5  # and how much of it the edges hide
ALIKE_PX, ALIKE_RADII = 3.0, 0.1  # seeds this close in place and in the logarithm of radius are one
SMALL = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (3, 3))
LARGE = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (11, 11))


def find_seeds(lightness: Lightness, *, taken: NDArray[np.generic]) -> Floats:
    """Centre x, y and radius of the convex hull of each seed, and whether it is a facet, (n, 4).

    Seeds whose middle is taken (rows, cols), not 0, are left out.
    """
    clear = by_strips(
        lambda kinds: ((kinds == LIT) | (kinds == SHADED)).view(np.uint8), lightness.kinds
    )
    solid = _opened(clear)
    parts = [_hulls(solid, fewest=MIN_PIXELS, rim_px=0)]
    closed = np.asarray(cv2.morphologyEx(solid, cv2.MORPH_CLOSE, LARGE), dtype=np.uint8)
    parts.append(_hulls(closed, fewest=MIN_PIXELS, rim_px=0))
    depth = by_strips(_depth_levels, solid, halo=2 * DEPTHS_PX[-1])
    del solid, closed
    parts += [
        _hulls((depth > level).view(np.uint8), fewest=MIN_IN_CORE, rim_px=px)
        for level, px in enumerate(DEPTHS_PX)
    ]
    del depth
    clear &= by_strips(_is_even, lightness.light, lightness.texture, halo=1)
    facets = _hulls(_opened(clear), fewest=MIN_IN_FACET, rim_px=FACET_RIM_PX)
    whole = np.concatenate(parts)
    seeds = np.concatenate(
        [np.insert(whole, 3, 0, axis=1), np.insert(facets, 3, 1, axis=1)], axis=0
    )
    middle = np.rint(seeds[:, :2]).astype(np.intp)
    return _different(seeds[taken[middle[:, 1], middle[:, 0]] == 0])


def _depth_levels(mask: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """How many of the depths each pixel exceeds, (rows, cols)."""
    depth = cv2.distanceTransform(mask, cv2.DIST_L2, 5)
    return np.asarray(np.searchsorted(DEPTHS_PX, depth, side="left"), dtype=np.uint8)


def _is_even(light: Singles, texture: Singles) -> NDArray[np.uint8]:
    """Whether no edge runs through a pixel, (rows, cols)."""
    across, down = (cv2.Sobel(light, cv2.CV_32F, *order, scale=0.125) for order in ((1, 0), (0, 1)))
    return (cv2.magnitude(across, down) < FACET_EDGE * texture).view(np.uint8)


def _opened(mask: NDArray[np.uint8]) -> NDArray[np.uint8]:
    return np.asarray(cv2.morphologyEx(mask, cv2.MORPH_OPEN, SMALL))


def _hulls(mask: NDArray[np.uint8], *, fewest: int, rim_px: float) -> Floats:
    """Centre x, y and radius of the hulls of a mask's regions, (n, 3); rim_px is added to radii."""
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    seeds = []
    for contour in contours:
        # Pick's theorem: the pixels within and on a border through their centres
        if cv2.contourArea(contour) + len(contour) / 2 + 1 < fewest:
            continue
        hull = cv2.convexHull(contour)
        moments = cv2.moments(hull)
        if moments["m00"] <= 4:
            continue
        x, y = moments["m10"] / moments["m00"], moments["m01"] / moments["m00"]
        radius = float(np.hypot(hull[:, 0, 0] - x, hull[:, 0, 1] - y).max())
        seeds.append((x, y, radius + rim_px))
    return np.array(seeds, dtype=np.float64).reshape(-1, 3)


def _different(seeds: Floats) -> Floats:
    """Of seeds (n, 4) that are alike in place, size and kind the first."""
    x, y, radius, facet = seeds.T
    key = np.column_stack([x / ALIKE_PX, y / ALIKE_PX, np.log(radius) / ALIKE_RADII, facet])
    _, first = np.unique(np.rint(key), axis=0, return_index=True)
    return seeds[np.sort(first)]
