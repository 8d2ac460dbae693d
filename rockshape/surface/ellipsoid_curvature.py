"""The second derivatives that a rock's ellipsoid alone would give."""

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid.half_axes import Ellipsoid
from rockshape.surface.patch import view_axes


def body_bends_per_m(ellipsoid: Ellipsoid, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """(h_uu + h_ww)/2 of the ellipsoid's near side over the places of points (n, 3), in 1/m.

    The places are those of `view_patch`. With F(u, w, h) = y^T M y - 1 = 0 the near side h(u, w)
    has h_u = -F_u/F_h and h_uu = -(F_uu + 2 F_uh h_u + F_hh h_u²)/F_h. NaN where the line through a
    point misses the ellipsoid, and for points without a view.
    """
    frame = view_axes(points_m)
    if frame is None:
        return np.full(len(points_m), np.nan)
    across, down, towards = frame
    offset = points_m - ellipsoid.centre_m
    matrix = (ellipsoid.axes.T / ellipsoid.half_axes_m**2) @ ellipsoid.axes
    # the line p + t towards meets the ellipsoid at a t² + 2 b t + c = 0, its near side last
    a = float(towards @ matrix @ towards)
    b = offset @ matrix @ towards
    c = np.einsum("ni,ij,nj->n", offset, matrix, offset) - 1
    root = b * b - a * c
    reach = (np.sqrt(np.where(root > 0, root, np.nan)) - b) / a
    slope = 2 * (offset + reach[:, None] * towards) @ matrix
    along_h = slope @ towards
    total = np.zeros(len(points_m))
    for axis in (across, down):
        tilt = -(slope @ axis) / along_h
        curve = 2 * (axis @ matrix @ axis + 2 * tilt * (axis @ matrix @ towards) + a * tilt**2)
        total -= curve / along_h
    return total / 2
