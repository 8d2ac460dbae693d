"""Polygon rasterisation: the pixels whose centres lie inside."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from rockshape.rock.instances import Window

BoxedMask = tuple[Window, NDArray[np.bool_]]


def fill_rings(rings: Iterable[NDArray[np.float64]], shape: tuple[int, int]) -> BoxedMask | None:
    """Pixels of an image inside an odd number of closed rings, in their box; None for no pixel.

    Each ring is (n, 2) as (x, y) of pixel corners: the first pixel's centre is at (0.5, 0.5). Of
    centres on an edge those on the right and bottom edges are inside, as with pycocotools, so that
    polygons that share an edge share no pixel, and corners at half pixels count no row twice.
    """
    edges = np.concatenate([np.hstack([ring, np.roll(ring, -1, axis=0)]) for ring in rings])
    x, y = edges[:, ::2], edges[:, 1::2]
    top, bottom = _whole_between(y, shape[0])
    left, right = _whole_between(x, shape[1])
    if top >= bottom or left >= right:
        return None
    crossings = np.zeros((bottom - top, right - left + 1), dtype=np.uint8)
    centres = np.arange(top, bottom) + 0.5
    for x0, y0, x1, y1 in edges.tolist():
        first, last = np.searchsorted(centres, sorted((y0, y1)), side="right")
        if first == last:
            continue
        across = x0 + (centres[first:last] - y0) * ((x1 - x0) / (y1 - y0))
        columns = np.floor(np.clip(across + 0.5, left, right)).astype(np.intp) - left
        crossings[np.arange(first, last), columns] ^= 1
    inside = np.bitwise_xor.accumulate(crossings[:, :-1], axis=1).astype(bool)
    return boxed(inside, top, left)


def boxed(mask: NDArray[np.bool_], top: int = 0, left: int = 0) -> BoxedMask | None:
    """Mask cut to the box of its pixels, and where that is; None where it has none."""
    rows, cols = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    if not len(rows):
        return None
    box = slice(rows[0], rows[-1] + 1), slice(cols[0], cols[-1] + 1)
    window = (
        slice(top + int(rows[0]), top + int(rows[-1]) + 1),
        slice(left + int(cols[0]), left + int(cols[-1]) + 1),
    )
    return window, mask[box]


def _whole_between(values: NDArray[np.float64], size: int) -> tuple[int, int]:
    """First and past-the-last pixel whose centre can lie between the values."""
    low, high = np.clip([values.min() - 1, values.max() + 1], 0, size)
    return int(low), int(np.ceil(high))
