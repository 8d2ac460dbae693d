"""Visible fraction of a rock, and whether the frame cuts it."""

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipse.direct import Ellipse
from rockshape.rock.instances import Instance, Instances, Window

MARGIN_PX = 8  # stereo matching leaves a margin of up to half its window without range


def measured_frame(known: NDArray[np.bool_]) -> tuple[slice, slice]:
    """The rows and columns of the frame without the margins where nothing is known.

    A margin wider than 8 pixels is no margin but a part of the scene, such as the sky.
    """
    sides = []
    for axis in (1, 0):
        filled = np.flatnonzero(known.any(axis=axis))
        size = known.shape[1 - axis]
        first, last = (int(filled[0]), int(filled[-1]) + 1) if len(filled) else (0, size)
        first = first if first <= MARGIN_PX else 0
        last = last if size - last <= MARGIN_PX else size
        sides.append(slice(first, last))
    return sides[0], sides[1]


def touches_border(window: tuple[slice, slice], frame: tuple[slice, slice]) -> bool:
    """Whether a rock's box touches the border of the frame, which may have cut the rock."""
    return any(
        side.start <= whole.start or side.stop >= whole.stop
        for side, whole in zip(window, frame, strict=True)
    )


def visible_fraction(
    rock: Instance,
    ellipse: Ellipse | None,
    instances: Instances,
    points_m: NDArray[np.float64] | None,
) -> float:
    """Share of a rock's fitted ellipse within the frame and not covered by a nearer rock, 0..1.

    instances are all rocks of the image, points_m (rows, cols, 3) its range. Which of two rocks is
    the nearer is told by the median distance of their points, so that without range only the frame
    counts. NaN where there is no ellipse.
    """
    if ellipse is None:
        return float("nan")
    inside, window = _raster(ellipse, instances.shape)
    if points_m is not None:
        inside &= ~_nearer(rock, instances, points_m[window], inside, window)
    return _share(inside, ellipse)


def uncovered_fraction(rock: Instance, ellipse: Ellipse | None, instances: Instances) -> float:
    """Share of a rock's fitted ellipse within the frame and not covered by any other rock, 0..1.

    It is the least that is visible where no range tells which of two rocks is the nearer. NaN where
    there is no ellipse.
    """
    if ellipse is None:
        return float("nan")
    inside, window = _raster(ellipse, instances.shape)
    for other in instances.meeting(window):
        if other.id != rock.id:
            inside &= ~_within(other, window)
    return _share(inside, ellipse)


def _raster(ellipse: Ellipse, shape: tuple[int, int]) -> tuple[NDArray[np.bool_], Window]:
    """Pixels of the frame inside an ellipse, on the window of its box."""
    cosine, sine = np.cos(ellipse.angle_rad), np.sin(ellipse.angle_rad)
    half_width = np.hypot(ellipse.major * cosine, ellipse.minor * sine)
    half_height = np.hypot(ellipse.major * sine, ellipse.minor * cosine)
    rows, cols = shape
    top, bottom = _reach(ellipse.y, half_height, rows)
    left, right = _reach(ellipse.x, half_width, cols)
    y, x = np.mgrid[top:bottom, left:right]
    offset_x, offset_y = x - ellipse.x, y - ellipse.y
    u = (offset_x * cosine + offset_y * sine) / ellipse.major
    v = (offset_y * cosine - offset_x * sine) / ellipse.minor
    return u * u + v * v <= 1, np.s_[top:bottom, left:right]


def _share(inside: NDArray[np.bool_], ellipse: Ellipse) -> float:
    """Share of an ellipse's area that pixels fill."""
    return float(min(1.0, inside.sum() / (np.pi * ellipse.major * ellipse.minor)))


def _reach(centre: float, half: float, size: int) -> tuple[int, int]:
    """First and past-the-last pixel within half of the centre and within the frame."""
    first = min(size, max(0, int(np.floor(centre - half))))
    return first, max(first, min(size, int(np.ceil(centre + half)) + 1))


def _nearer(
    rock: Instance,
    instances: Instances,
    points_m: NDArray[np.float64],
    inside: NDArray[np.bool_],
    window: Window,
) -> NDArray[np.bool_]:
    """Pixels of the window that belong to a rock nearer to the camera than this one."""
    distance = np.linalg.norm(points_m, axis=-1)
    known = np.isfinite(distance)
    nearer = np.zeros(inside.shape, dtype=bool)
    own = _within(rock, window)
    if not (known & own).any():
        return nearer
    own_m = np.median(distance[known & own])
    for other in instances.meeting(window):
        theirs = _within(other, window)
        if other.id == rock.id or not (theirs & inside & known).any():
            continue
        if np.median(distance[known & theirs]) < own_m:
            nearer |= theirs & ~own
    return nearer


def _within(rock: Instance, window: Window) -> NDArray[np.bool_]:
    """A rock's mask on a window of the image."""
    (top, bottom), (left, right) = (
        (max(one.start, two.start), min(one.stop, two.stop))
        for one, two in zip(rock.window, window, strict=True)
    )
    mask = np.zeros(tuple(max(0, side.stop - side.start) for side in window), dtype=bool)
    if top >= bottom or left >= right:
        return mask
    here, there = (
        np.s_[top - rows.start : bottom - rows.start, left - cols.start : right - cols.start]
        for rows, cols in (window, rock.window)
    )
    mask[here] = rock.mask[there]
    return mask
