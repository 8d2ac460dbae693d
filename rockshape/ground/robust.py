"""A ground plane that holds where rocks cover much of the ground and noise grows with distance.

A plane n . p = o is a linear function of the ray r = (X/Z, Y/Z, 1) in inverse depth,
1/Z = (n/o) . r, and the inverse depth's noise is even over a stereo camera's frame. What stands on
the ground is nearer than the ground behind it along the same ray, so rocks lie on one side of it.
"""

from dataclasses import dataclass

import numpy as np

from rockshape.numerics.arrays import Floats
from rockshape.numerics.robust_scale import MEDIAN_TO_SIGMA

TRIED = 400  # planes through three points
JUDGES = 1200  # points by which they are judged
SHARE = 0.35  # of the points is taken to be ground that any good plane must have close by
BELOW = 8.0  # how much a point far below a plane counts against it
ROUNDS = 12
CUT = 2.5  # scatters from the plane beyond which a point has no weight
SEED = 20020309  # draws are fixed: equal points give equal planes


@dataclass(frozen=True, eq=False)
class InverseDepthPlane:
    """1/Z = coefficients . (X/Z, Y/Z, 1), and the scatter of the ground about it."""

    coefficients: Floats  # (3,), 1/m
    scatter_per_m: float
    accepted: float  # share of the points within the cut


def fit_inverse_depth(rays: Floats, inverse_depth: Floats) -> InverseDepthPlane | None:
    """The plane of the ground among rocks, from rays (n, 3) and inverse depths (n,) in 1/m.

    Of 400 planes through three points drawn, the one is taken whose residuals have the shortest
    interval that holds 35 % of the points, lengthened for each share of points that lie far below
    it, where nothing but faults of the range can be (least quantile of squares, Rousseeuw 1984,
    with a side). It is refined by iterated least squares with Tukey's weights, whose scale is that
    of the points below the plane, for rocks are above. None where fewer than three points are given
    or all planes drawn are through points on a line.
    """
    if len(rays) < 3:
        return None
    start = _draw_start(rays, inverse_depth)
    if start is None:
        return None
    coefficients, scatter = start
    floor = 1e-7 * float(np.median(np.abs(inverse_depth)))
    for _ in range(ROUNDS):
        residual = inverse_depth - rays @ coefficients
        below = residual[(residual < 0) & (residual > -6 * max(scatter, floor))]
        if len(below) > 10:
            scatter = MEDIAN_TO_SIGMA * float(np.median(-below))
        scale = CUT * max(scatter, floor)
        weight = np.maximum(1 - (residual / scale) ** 2, 0) ** 2
        weighted = rays * weight[:, None]
        try:
            step = np.linalg.solve(weighted.T @ rays, weighted.T @ residual)
        except np.linalg.LinAlgError:
            return None
        coefficients = coefficients + step
    near = np.abs(inverse_depth - rays @ coefficients) <= CUT * max(scatter, floor)
    return InverseDepthPlane(coefficients, scatter, float(near.mean()))


def _draw_start(rays: Floats, inverse_depth: Floats) -> tuple[Floats, float] | None:
    """The best of the planes drawn and half the length of its interval."""
    rng = np.random.default_rng(SEED)
    judges = rng.choice(len(rays), min(JUDGES, len(rays)), replace=False)
    corners = rng.integers(len(rays), size=(TRIED, 3))
    matrices = rays[corners]
    solid = np.abs(np.linalg.det(matrices)) > 1e-9
    if not solid.any():
        return None
    planes = np.linalg.solve(matrices[solid], inverse_depth[corners[solid]][..., None])[..., 0]
    residual = np.sort(inverse_depth[judges] - planes @ rays[judges].T, axis=1)
    held = max(2, round(SHARE * residual.shape[1]))
    widths = residual[:, held - 1 :] - residual[:, : residual.shape[1] - held + 1]
    first = widths.argmin(axis=1)
    rows = np.arange(len(residual))
    width = widths[rows, first]
    middle = residual[rows, first] + width / 2
    below = (residual < (middle - 2 * width)[:, None]).mean(axis=1)
    best = int(np.argmin(width * (1 + BELOW * below)))
    plane = planes[best].copy()
    plane[2] += middle[best]
    return plane, float(width[best] / 2)
