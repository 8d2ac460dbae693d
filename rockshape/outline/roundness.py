"""Wadell's roundness: how round the corners of an outline are beside its largest inscribed circle.

The hard part is the pixel. A corner's circle, fitted to the staircase, is the sharper the more
pixels the staircase has, and that is why roundness from most tools falls as the picture grows.
Here the outline's curvature is smoothed by a known Gaussian, and what that did to each corner is
undone.
"""

from math import erf, pi, sqrt

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.outline.resample import canonical, even_outline, outline_length
from rockshape.outline.trace import signed_area

MIN_POINTS = 40  # evenly spaced points, about a pixel apart
# The noise that pixels make in curvature falls with sigma^2.5 while curvature falls with the
# radius R: sigma grows more slowly than R. Tuned on rounded polygons of 30 to 500 px.
_SIGMA = 0.68
_SIGMA_POWER = 0.6
_PROMINENCE = 0.2  # of 1/R: less than that above its surroundings is no corner of its own
_MIN_TURN_RAD = 0.2  # a corner that turns less is a ripple
_FULL_CONTRAST = 0.8  # from here on a corner counts as an arc between straight sides
_CONTACTS = 256  # points that can touch it: between them a circle passes by 1e-4 of its radius
_UNIT = 4096  # the triangulation tells points apart by a fixed distance, 1e-7
_NO_AREA = 1e-6  # of the extent squared

_U = np.concatenate([np.linspace(0.0, 4.0, 801), np.geomspace(4.02, 400.0, 200)])
_BLUR = np.array([2 / sqrt(pi), *(erf(u) / u for u in _U[1:])])  # falls from 1.128 to 0


def wadell_roundness(outline_px: NDArray[np.float64]) -> float:
    """Mean radius of curvature of the corners over the radius R of the largest inscribed circle.

    outline_px is (n, 2), closed, evenly spaced and about a pixel apart, without its staircase
    (`pixel_smooth`). A corner is where the radius of curvature is less than R. The curvature,
    the derivative of the bearing along the outline, is smoothed by sigma = 0.68 R^0.6 (px). An arc
    of length l that turns by theta between straight sides then peaks at

        kappa = (theta / l) erf(l / (2 sqrt(2) sigma)),

    which is solved for l: the corner's radius is l / theta, 0 where the peak is as high as a
    sharp corner's. theta is the turning from valley to valley; where the valleys are not straight
    the peak itself is the more to be believed, and the correction is faded out in proportion.
    1 where there is no corner: a disc, a stadium. NaN for fewer than 40 points or no inscribed
    circle.
    Source: Wadell (1932), Volume, shape, and roundness of rock particles.
    """
    if len(outline_px) < MIN_POINTS:
        return float("nan")
    ring = canonical(outline_px)
    radius = inscribed_radius(ring)
    if not radius > 0:
        return float("nan")
    sigma = _SIGMA * radius**_SIGMA_POWER
    curvature, step = smooth_curvature(ring, sigma=sigma)
    corners = _corners(curvature, _PROMINENCE / radius)
    radii = []
    for index, (valley, peak) in enumerate(corners):
        following = corners[(index + 1) % len(corners)][0]
        span = (following - valley) % len(curvature) or len(curvature)
        between = curvature[(valley + np.arange(span + 1)) % len(curvature)]
        floor = float(between[0] + between[-1]) / 2
        theta = step * (float(between.sum()) - floor)
        height = float(curvature[peak])
        if height > 1 / radius and theta > _MIN_TURN_RAD:
            radii.append(min(radius, _corner_radius(height, floor, theta, sigma)))
    return float(np.mean(radii) / radius) if radii else 1.0


def _corner_radius(height: float, floor: float, theta: float, sigma: float) -> float:
    """Radius of the arc that turns by theta and peaks at a height once smoothed by sigma."""
    blur = height * 2 * sqrt(2) * sigma / theta
    length = 2 * sqrt(2) * sigma * float(np.interp(-blur, -_BLUR, _U))
    if length == 0:
        return 0.0
    sharper = theta / length / height  # than it looks, at least 1
    trust = min(1.0, (height - floor) / height / _FULL_CONTRAST)
    return 1 / (height * (1 + (sharper - 1) * trust))


def smooth_curvature(
    outline: NDArray[np.float64], *, sigma: float
) -> tuple[NDArray[np.float64], float]:
    """Curvature (n,) of a clockwise, evenly spaced outline (n, 2), smoothed; and the step.

    The bearing less its steady turn is periodic, so its derivative and the Gaussian of width
    sigma are one multiplication at each harmonic. Convex is positive. In 1 over the outline's
    unit.
    """
    count, length = len(outline), outline_length(outline)
    x, y = outline.T
    bearing = np.unwrap(np.arctan2(np.diff(y, append=y[:1]), np.diff(x, append=x[:1])))
    swing = bearing - 2 * np.pi * np.arange(count) / count
    wave = np.fft.rfftfreq(count, 1 / count) * (2 * np.pi / length)
    waves = np.fft.rfft(swing) * 1j * wave * np.exp(-((wave * sigma) ** 2) / 2)
    return np.fft.irfft(waves, count) + 2 * np.pi / length, length / count


def _corners(curvature: NDArray[np.float64], prominence: float) -> list[tuple[int, int]]:
    """Each corner's preceding valley and its peak, in order, by falling persistence.

    Of the lows and highs that alternate round the outline the pair that differs least goes, until
    all differ by the prominence.
    """
    rising = curvature < np.roll(curvature, -1)
    turns = np.flatnonzero(rising != np.roll(rising, 1)).tolist()
    while turns:
        heights = curvature[turns]
        steps = np.abs(np.roll(heights, -1) - heights)
        least = int(steps.argmin())
        if steps[least] >= prominence:
            break
        gone = {least, (least + 1) % len(turns)}
        turns = [turn for index, turn in enumerate(turns) if index not in gone]
    if not turns:
        return []
    if not rising[turns[0]]:
        turns = turns[1:] + turns[:1]
    return list(zip(turns[::2], turns[1::2], strict=True))


def inscribed_radius(outline: NDArray[np.float64]) -> float:
    """Radius of the largest circle inside a closed outline (n, 2); 0 where there is no inside."""
    return inscribed_circle(outline)[1]


def inscribed_circle(outline: NDArray[np.float64]) -> tuple[tuple[float, float], float]:
    """Centre and radius of the largest circle inside a closed outline (n, 2), in its unit.

    Of 256 points evenly along it, every triangle of their Delaunay triangulation has a
    circumscribed circle with no point inside; the largest whose centre lies inside the outline
    is the one. In single precision: true to 1e-7. Of radius 0 for an outline without inside.
    """
    points = even_outline(outline, _CONTACTS)
    if len(points) == 0:
        return (0.0, 0.0), 0.0
    scale = float(np.ptp(points, axis=0).max())
    middle = points.mean(axis=0)
    points = (points - middle) / scale
    if abs(signed_area(points)) < _NO_AREA:
        return (0.0, 0.0), 0.0
    first, second, third = np.moveaxis(_triangles(points), 1, 0)
    one, two = second - first, third - first
    cross = 2 * (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
    level = np.column_stack([(one**2).sum(axis=1), (two**2).sum(axis=1)])
    with np.errstate(divide="ignore", invalid="ignore"):
        x = (two[:, 1] * level[:, 0] - one[:, 1] * level[:, 1]) / cross
        y = (one[:, 0] * level[:, 1] - two[:, 0] * level[:, 0]) / cross
    radius = np.hypot(x, y)
    polygon = points.astype(np.float32)
    # none inside is larger than the half extent; flat triangles have none
    for index in np.argsort(-np.where(radius <= 1, radius, 0.0)):
        centre = (float(first[index, 0] + x[index]), float(first[index, 1] + y[index]))
        if radius[index] <= 1 and cv2.pointPolygonTest(polygon, centre, measureDist=False) > 0:
            x_own, y_own = (middle + scale * np.array(centre)).tolist()
            return (x_own, y_own), scale * float(radius[index])
    return (0.0, 0.0), 0.0


def _triangles(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Corners (k, 3, 2) of the Delaunay triangles of points (n, 2) within 1 of the origin."""
    side = 2 * _UNIT
    plane = cv2.Subdiv2D((-side, -side, 2 * side, 2 * side))
    plane.insert((_UNIT * points).astype(np.float32).tolist())
    corners = np.asarray(plane.getTriangleList()).reshape(-1, 3, 2) / float(_UNIT)
    # the triangulation starts from three points far outside
    return np.asarray(corners[(np.abs(corners) <= 1).all(axis=(1, 2))])
