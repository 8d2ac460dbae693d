"""Rings round a mask's pixels: polygons of pixel corners that hold exactly these pixels."""

import numpy as np
from numpy.typing import NDArray

Ring = NDArray[np.int64]


def pixel_rings(mask: NDArray[np.bool_]) -> list[Ring]:
    """Closed rings (n, 2) as (x, y) of a mask (rows, cols), the first point not repeated.

    Corner (0, 0) is that of the first pixel. Outer rings are clockwise as seen, those of holes the
    other way; where pixels touch at a corner only, rings part. Points on a straight side are left
    out.
    """
    following = _sides(np.pad(mask, 1))
    rings = []
    while following:
        start = next(iter(following))
        ring, here, last = [], start, (0, 0)
        while here in following:
            ends = following[here]
            chosen = ends[0] if len(ends) == 1 else _right_turn(here, last, ends)
            ends.remove(chosen)
            if not ends:
                del following[here]
            ring.append(here)
            last = chosen[0] - here[0], chosen[1] - here[1]
            here = chosen
        rings.append(_corners(np.array(ring)))
    return rings


def signed_area(ring: Ring) -> float:
    """Area of a ring, positive of an outer one."""
    x, y = ring.T
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) / 2)


Corner = tuple[int, int]


def _sides(padded: NDArray[np.bool_]) -> dict[Corner, list[Corner]]:
    """Ends of the sides that begin at each corner, with the mask to their right."""
    found: dict[Corner, list[Corner]] = {}

    for touching, begin, end in (
        (padded[1:] & ~padded[:-1], (0, 1), (1, 1)),  # top sides
        (padded[:-1] & ~padded[1:], (1, 1), (0, 1)),  # bottom sides
        (padded[:, :-1] & ~padded[:, 1:], (1, 0), (1, 1)),  # right sides
        (padded[:, 1:] & ~padded[:, :-1], (1, 1), (1, 0)),  # left sides
    ):
        rows, cols = np.nonzero(touching)
        for y, x in zip((rows - 1).tolist(), (cols - 1).tolist(), strict=True):
            side = (x + begin[0], y + begin[1]), (x + end[0], y + end[1])
            found.setdefault(side[0], []).append(side[1])
    return found


def _right_turn(here: Corner, last: Corner, ends: list[Corner]) -> Corner:
    """Next corner where two pixels touch at one: the pixel's own, which is to the right."""
    right = here[0] - last[1], here[1] + last[0]
    return right if right in ends else ends[0]


def _corners(ring: Ring) -> Ring:
    """Ring without points on a straight side."""
    before, after = ring - np.roll(ring, 1, axis=0), np.roll(ring, -1, axis=0) - ring
    return np.asarray(ring[(before != after).any(axis=1)])
