"""The least-squares ellipse of an outline, and how far points lie from it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FEWEST_POINTS = 6  # one more than an ellipse has unknowns
LARGEST = 10.0  # semi-axis in RMS radii of the outline: two parallel lines ask for infinity
FLATTEST = 1e-3  # axis ratio below which the conic is a pair of lines

# 4ac - b² of the conic a x² + b xy + c y² + ...: positive for an ellipse
_CONSTRAINT = np.array([[0.0, 0.0, 2.0], [0.0, -1.0, 0.0], [2.0, 0.0, 0.0]])


@dataclass(frozen=True)
class Ellipse:
    """An ellipse in the image. All lengths in pixels."""

    x: float  # centre
    y: float
    major: float  # semi-axes, major >= minor
    minor: float
    angle_rad: float  # from x to the major axis, towards y (clockwise as seen), in (-pi/2, pi/2]

    @property
    def axis_ratio(self) -> float:
        """Minor over major axis, 0 to 1."""
        return self.minor / self.major

    def radial_distance(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Signed distances (n,) of points (n, 2), outside positive, along the ray from the centre.

        With p the vector from the centre and q = (p_u/a)² + (p_v/b)² in the ellipse's own axes, the
        ray meets the ellipse at p/sqrt(q), so the distance is |p| (1 - 1/sqrt(q)). It exceeds the
        orthogonal distance by a factor of up to (a² + b²)/(2ab). The centre itself lies -b away.
        Source: Fox et al. (2002), figure 2.
        """
        offset = points - (self.x, self.y)
        cosine, sine = np.cos(self.angle_rad), np.sin(self.angle_rad)
        u = offset @ (cosine, sine)
        v = offset @ (-sine, cosine)
        length = np.hypot(u, v)
        level = np.hypot(u / self.major, v / self.minor)
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = length * (1 - 1 / level)
        return np.where(level > 0, distance, -self.minor)


def fit_ellipse(points: NDArray[np.float64]) -> Ellipse | None:
    """Direct least-squares ellipse: minimises the algebraic distance under 4ac - b² = 1.

    points is (n, 2) as (x, y). Centred and scaled first, since the system is badly conditioned far
    from the origin, and solved as the reduced 3x3 eigenproblem whose only solution with
    4ac - b² > 0 is the ellipse; "the one positive eigenvalue" of the full system fails on points
    that lie exactly on an ellipse. None for fewer than six points, or where no ellipse is
    determined: points on a line, on two parallel lines, or on an arc so flat that the semi-axis
    exceeds ten times the RMS distance of the points from their centroid.
    Source: Fox et al. (2002), equations 3 to 5, after Fitzgibbon, Pilu and Fisher (1999); solved
    after Halíř and Flusser (1998).
    """
    if len(points) < FEWEST_POINTS:
        return None
    centre = points.mean(axis=0)
    scale = float(np.sqrt(((points - centre) ** 2).sum(axis=1).mean()))
    if scale == 0:
        return None
    x, y = ((points - centre) / scale).T
    quadratic = np.column_stack([x * x, x * y, y * y])
    linear = np.column_stack([x, y, np.ones_like(x)])
    scatter = linear.T @ linear
    if np.linalg.cond(scatter) > 1e12:
        return None
    reduce = -np.linalg.solve(scatter, linear.T @ quadratic)
    system = np.linalg.solve(_CONSTRAINT, quadratic.T @ (quadratic + linear @ reduce))
    _, vectors = np.linalg.eig(system)
    vectors = np.real(vectors)
    ellipse_like = 4 * vectors[0] * vectors[2] - vectors[1] ** 2
    if not np.max(ellipse_like) > 0:
        return None
    conic = vectors[:, int(np.argmax(ellipse_like))]
    return _from_conic(np.concatenate([conic, reduce @ conic]), centre, scale)


def _from_conic(
    conic: NDArray[np.float64], centre: NDArray[np.float64], scale: float
) -> Ellipse | None:
    a, b, c, d, e, f = conic
    shape = np.array([[a, b / 2], [b / 2, c]])
    values, axes = np.linalg.eigh(shape)
    if np.abs(values).min() <= FLATTEST**2 * np.abs(values).max():
        return None
    middle = np.linalg.solve(shape, [-d / 2, -e / 2])
    squares = (middle @ shape @ middle - f) / values
    if np.any(squares <= 0) or np.any(squares > LARGEST**2):
        return None
    longest = int(np.argmax(squares))
    direction = axes[:, longest]
    angle = float(np.arctan2(direction[1], direction[0]))
    if angle <= -np.pi / 2:
        angle += np.pi
    elif angle > np.pi / 2:
        angle -= np.pi
    x, y = centre + scale * middle
    major, minor = scale * np.sqrt([squares[longest], squares[1 - longest]])
    return Ellipse(x=float(x), y=float(y), major=float(major), minor=float(minor), angle_rad=angle)
