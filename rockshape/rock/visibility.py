"""Visible fraction of a rock, and whether the frame cuts it."""

from typing import NamedTuple

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


class Visibility(NamedTuple):
    """Shares of a rock's fitted ellipse that are visible, 0..1; NaN where there is no ellipse."""

    fraction: float  # in the frame, and not behind a rock that range tells to be nearer
    least: float  # nor where another rock, unless it is known to be farther, or ignored pixels are


def visibility(
    rock: Instance,
    ellipse: Ellipse | None,
    instances: Instances,
    points_m: NDArray[np.float64] | None,
    ignored: NDArray[np.bool_] | None,
) -> Visibility:
    """Visibility of a rock among all of the image, `instances`, with the image's range.

    points_m is (rows, cols, 3). Which of two rocks is the nearer is told by the median distance of
    their points; where one has none it is unknown. ignored (rows, cols) are pixels left out.
    """
    if ellipse is None:
        return Visibility(float("nan"), float("nan"))
    inside, window = _raster(ellipse, instances.shape)
    nearer, perhaps = _covered(rock, instances, points_m, inside, window)
    if ignored is not None:
        perhaps |= ignored[window]
    area = np.pi * ellipse.major * ellipse.minor
    seen = ((inside & ~hidden).sum() for hidden in (nearer, nearer | perhaps))
    return Visibility(*(float(min(1.0, count / area)) for count in seen))


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


def _reach(centre: float, half: float, size: int) -> tuple[int, int]:
    """First and past-the-last pixel within half of the centre and within the frame."""
    first = min(size, max(0, int(np.floor(centre - half))))
    return first, max(first, min(size, int(np.ceil(centre + half)) + 1))


def _covered(
    rock: Instance,
    instances: Instances,
    points_m: NDArray[np.float64] | None,
    inside: NDArray[np.bool_],
    window: Window,
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Pixels of the window of rocks nearer to the camera than this one, and of those in doubt."""
    nearer, doubtful = np.zeros_like(inside), np.zeros_like(inside)
    if points_m is None:
        distance_m = np.full(inside.shape, np.nan)
    else:
        distance_m = np.linalg.norm(points_m[window], axis=-1)
    own = _within(rock, window)
    own_m = _median(distance_m[own])
    for other in instances.meeting(window):
        theirs = _within(other, window) & ~own
        if other.id == rock.id or not (theirs & inside).any():
            continue
        other_m = _median(distance_m[theirs])
        if other_m < own_m:
            nearer |= theirs
        elif np.isnan(other_m) or np.isnan(own_m):
            doubtful |= theirs
    return nearer, doubtful


def _median(distances_m: NDArray[np.float64]) -> float:
    """Median of the distances that are known; NaN where none is."""
    known = distances_m[np.isfinite(distances_m)]
    return float(np.median(known)) if len(known) else float("nan")


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
