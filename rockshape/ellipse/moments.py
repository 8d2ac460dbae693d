"""The ellipse with the area moments of an outline."""

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipse.direct import Ellipse


def moment_ellipse(outline: NDArray[np.float64]) -> Ellipse | None:
    """Ellipse with the second moments, per area, that the inside of a polygon (n, 2) has.

    With C the covariance of the inside, by Green's theorem over the sides, the semi-axes are twice
    the roots of its eigenvalues. It is the outline's own ellipse if that is one, takes the whole
    area's word rather than the points', and asks no point where it lies between its neighbours;
    an outline cut by the frame it takes for whole (see `fit_arc`). None for an outline of no area.
    Source: Steger (1996), On the calculation of arbitrary moments of polygons; the convention of
    scikit-image's regionprops.
    """
    if len(outline) < 3:
        return None
    middle = outline.mean(axis=0)
    x, y = (outline - middle).T.copy()
    next_x, next_y = np.append(x[1:], x[0]), np.append(y[1:], y[0])
    cross = x * next_y - next_x * y
    area = cross.sum() / 2
    if area == 0:
        return None
    shift = np.array([(x + next_x) @ cross, (y + next_y) @ cross]) / (6 * area)
    xx = (x * x + x * next_x + next_x * next_x) @ cross
    yy = (y * y + y * next_y + next_y * next_y) @ cross
    xy = (2 * x * y + x * next_y + next_x * y + 2 * next_x * next_y) @ cross / 2
    covariance = np.array([[xx, xy], [xy, yy]]) / (12 * area) - np.outer(shift, shift)
    (low, high), axes = np.linalg.eigh(covariance)
    if low <= 1e-12 * high:
        return None
    angle = float(np.arctan2(axes[1, 1], axes[0, 1]))
    angle -= np.pi * round(angle / np.pi)
    return Ellipse(
        x=float(middle[0] + shift[0]),
        y=float(middle[1] + shift[1]),
        major=float(2 * np.sqrt(high)),
        minor=float(2 * np.sqrt(low)),
        angle_rad=angle,
    )
