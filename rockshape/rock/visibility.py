"""How much of a rock the image shows."""

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipse.direct import Ellipse

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
    number: int,
    ellipse: Ellipse | None,
    labels: NDArray[np.int32],
    points_m: NDArray[np.float64] | None,
) -> float:
    """Share of a rock's fitted ellipse within the frame and not covered by a nearer rock, 0..1.

    Which of two rocks is the nearer is told by the median distance of their points, so that without
    range only the frame counts. NaN where there is no ellipse.
    """
    if ellipse is None:
        return float("nan")
    cosine, sine = np.cos(ellipse.angle_rad), np.sin(ellipse.angle_rad)
    half_width = np.hypot(ellipse.major * cosine, ellipse.minor * sine)
    half_height = np.hypot(ellipse.major * sine, ellipse.minor * cosine)
    rows, cols = labels.shape
    top, bottom = _reach(ellipse.y, half_height, rows)
    left, right = _reach(ellipse.x, half_width, cols)
    y, x = np.mgrid[top:bottom, left:right]
    offset_x, offset_y = x - ellipse.x, y - ellipse.y
    u = (offset_x * cosine + offset_y * sine) / ellipse.major
    v = (offset_y * cosine - offset_x * sine) / ellipse.minor
    inside = u * u + v * v <= 1
    whole = np.pi * ellipse.major * ellipse.minor
    if points_m is not None:
        window = np.s_[top:bottom, left:right]
        inside &= ~_nearer(number, labels[window], points_m[window], inside)
    return float(min(1.0, inside.sum() / whole))


def _reach(centre: float, half: float, size: int) -> tuple[int, int]:
    """First and past-the-last pixel within half of the centre and within the frame."""
    return max(0, int(np.floor(centre - half))), min(size, int(np.ceil(centre + half)) + 1)


def _nearer(
    number: int,
    labels: NDArray[np.int32],
    points_m: NDArray[np.float64],
    inside: NDArray[np.bool_],
) -> NDArray[np.bool_]:
    """Pixels of the window that belong to a rock nearer to the camera than this one."""
    distance = np.linalg.norm(points_m, axis=-1)
    known = np.isfinite(distance)
    nearer = np.zeros(labels.shape, dtype=bool)
    if not (known & (labels == number)).any():
        return nearer
    own = np.median(distance[known & (labels == number)])
    for other in np.unique(labels[inside & known & (labels != 0) & (labels != number)]):
        theirs = labels == other
        if np.median(distance[known & theirs]) < own:
            nearer |= theirs
    return nearer
