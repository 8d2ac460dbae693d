"""Camera at the origin of a range grid, found from the pixels and the points seen at them."""

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.camera.resection import MIN_PIXELS, MOST_OUTLIERS, Resection, near, sampled


def calibrate(points_m: NDArray[np.float64]) -> Resection | None:
    """Find the camera at the origin, looking along z, that saw points_m, (rows, cols, 3).

    The lines u = fx X/Z + cx and v = fy Y/Z + cy through all pixels but outliers, by least squares;
    the principal point is free. None where fewer than 12 pixels have a point, or no such camera
    can have seen them.
    """
    rows, cols = points_m.shape[:2]
    row, col, points = sampled(points_m)
    front = points[:, 2] > 0
    if len(row) < MIN_PIXELS or front.mean() < 1 - MOST_OUTLIERS:
        return None
    row, col, points = row[front], col[front], points[front]
    across, down = (points[:, :2] / points[:, 2:]).T
    horizontal, vertical = _line(across, col), _line(down, row)
    if horizontal is None or vertical is None:
        return None
    (fx, cx), (fy, cy) = horizontal, vertical
    misses = np.hypot(fx * across + cx - col, fy * down + cy - row)
    return Resection(
        camera=Camera(fx, fy, cx, cy, cols, rows),
        rotation=np.eye(3),
        translation_m=np.zeros(3),
        residual_px=float(np.median(misses)),
    )


def _line(ratio: NDArray[np.float64], place: NDArray[np.intp]) -> tuple[float, float] | None:
    """Focal length and principal point, px, of the line place = f ratio + c without outliers.

    The start is the median slope of pairs, each ratio at its own pixel (Theil 1950); None where
    the ratios do not rise with the pixels.
    """
    half = len(place) // 2
    apart = place[half : 2 * half] - place[:half]
    pairs = apart != 0
    if not pairs.any():
        return None
    slope = np.median((ratio[half : 2 * half] - ratio[:half])[pairs] / apart[pairs])
    if not slope > 0:
        return None
    misses = np.abs(ratio / slope - place - np.median(ratio / slope - place))
    sound = near(misses)
    if np.ptp(ratio[sound]) == 0:
        return None
    focal, centre = np.polyfit(ratio[sound], place[sound], 1)
    return (float(focal), float(centre)) if focal > 0 else None
