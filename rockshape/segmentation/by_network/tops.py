"""Tops of a map that stand out: one in each rock."""

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Mask, Singles

Whole = NDArray[np.intp]

STEPS = 20  # levels between 0 and 1
LOWEST = 2  # of them that is looked at


def tops(height: Singles, mask: Mask, *, rise: float) -> Whole:
    """Pixels (n,), as places in the flattened map, of the tops within a mask.

    A top stands at least `rise` above the highest pass to a higher one (its dynamics, Grimaud
    1992), told to a twentieth. Levels are taken from the highest to the lowest; a connected part of
    what lies above a level is a new top where it holds none yet, and where two meet, the lower goes
    unless it has risen enough.
    """
    place, peak = np.empty(0, dtype=np.intp), np.empty(0, dtype=np.intp)
    for level in range(STEPS - 1, LOWEST - 1, -1):
        above = ((height > level / STEPS) & mask).astype(np.uint8)
        count, parts = cv2.connectedComponents(above, connectivity=4)
        part = np.asarray(parts, dtype=np.int32).ravel()
        held = np.zeros(count, dtype=bool)
        held[part[place]] = True
        held[0] = True
        place, peak = _survivors(place, peak, part, least=level + rise * STEPS)
        if not held.all():
            fresh = _one_pixel_each(part, ~held)
            place = np.concatenate([place, fresh])
            peak = np.concatenate([peak, np.full(len(fresh), level)])
    return place


def _survivors(
    place: Whole, peak: Whole, part: NDArray[np.int32], *, least: float
) -> tuple[Whole, Whole]:
    """Tops that are the highest of their part, or began at the least level or above."""
    order = np.lexsort((-peak, part[place]))
    own = part[place][order]
    first = np.ones(len(order), dtype=bool)
    first[1:] = own[1:] != own[:-1]
    keep = first | (peak[order] >= least)
    return place[order][keep], peak[order][keep]


def _one_pixel_each(part: NDArray[np.int32], wanted: Mask) -> Whole:
    """A pixel of each wanted part."""
    pixels = np.flatnonzero(wanted[part])
    chosen = np.zeros(len(wanted), dtype=np.intp)
    chosen[part[pixels]] = pixels
    return chosen[wanted]
