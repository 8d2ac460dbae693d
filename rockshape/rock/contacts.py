"""Contacts: the parts of a rock's edge that neighbours, ignored regions or the frame have made."""

import numpy as np
from numpy.typing import NDArray

from rockshape.rock.instances import Instance, Instances, Window


def not_ground(
    rock: Instance, instances: Instances, frame: Window, ignored: NDArray[np.bool_] | None
) -> NDArray[np.bool_]:
    """Pixels in and one round a rock's window that hide where it ends, (rows + 2, cols + 2).

    Those of other rocks, ignored ones (rows, cols of the image), and those beyond the frame. A rock
    that shares pixels with this one hides nothing: both masks are then whole.
    """
    start = rock.window[0].start - 1, rock.window[1].start - 1
    hidden = np.ones([size + 2 for size in rock.mask.shape], dtype=np.bool_)
    window = _window_at(start, hidden.shape)
    here, there = _common(window, frame)
    hidden[here] = False if ignored is None else ignored[_window_of(frame, there)]
    own = np.pad(rock.mask, 1)
    for other in instances.meeting(window):
        here, there = _common(window, other.window)
        theirs = other.mask[there]
        if other.id != rock.id and not (theirs & own[here]).any():
            hidden[here] |= theirs
    return hidden & ~own


def _window_at(start: tuple[int, int], shape: tuple[int, ...]) -> Window:
    rows, cols = (slice(at, at + size) for at, size in zip(start, shape, strict=True))
    return rows, cols


def _window_of(outer: Window, inner: Window) -> Window:
    """A window of a window as one of the image."""
    rows, cols = (
        slice(whole.start + part.start, whole.start + part.stop)
        for whole, part in zip(outer, inner, strict=True)
    )
    return rows, cols


def _common(one: Window, other: Window) -> tuple[Window, Window]:
    """What two windows of the image have in common, as a part of each."""
    first, second = [], []
    for mine, theirs in zip(one, other, strict=True):
        start = max(mine.start, theirs.start)
        stop = max(start, min(mine.stop, theirs.stop))
        first.append(slice(start - mine.start, stop - mine.start))
        second.append(slice(start - theirs.start, stop - theirs.start))
    return (first[0], first[1]), (second[0], second[1])


def contact_points(
    edge_px: NDArray[np.float64], corner: tuple[int, int], hidden: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Which points (n, 2) of an edge lie beside a pixel that hides where the rock ends.

    corner is the row and column of the rock's window; hidden as `not_ground` has it.
    """
    x, y = (edge_px - np.array(corner[::-1], dtype=np.float64) + 1).T
    last_row, last_col = hidden.shape[0] - 1, hidden.shape[1] - 1
    found = np.zeros(len(edge_px), dtype=np.bool_)
    for near_y in (np.floor(y), np.ceil(y)):
        for near_x in (np.floor(x), np.ceil(x)):
            row = np.clip(near_y, 0, last_row).astype(np.intp)
            found |= hidden[row, np.clip(near_x, 0, last_col).astype(np.intp)]
    return found
