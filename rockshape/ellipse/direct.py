"""The least-squares ellipse of an outline, and how far points lie from it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

MIN_POINTS = 6  # one more than an ellipse has unknowns
LARGEST = 10.0  # semi-axis in RMS radii of the outline: two parallel lines ask for infinity
ON_A_LINE = 1e-12  # least over summed spread of points whose ellipse is not determined
FLATTEST = 1e-3  # axis ratio below which the conic is a pair of lines

_NEWTON_STEPS = 50
_NEWTON_SETTLED = 1e-14  # of the squared semi-axis

# 4ac - b² of the conic a x² + b xy + c y² + ...: positive for an ellipse
_CONSTRAINT_INVERSE = np.array([[0.0, 0.0, 0.5], [0.0, -1.0, 0.0], [0.5, 0.0, 0.0]])


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

    def ring(self, count: int = 128) -> NDArray[np.float64]:
        """Points (count, 2) round the ellipse, closed."""
        turns = np.linspace(0, 2 * np.pi, count, endpoint=False)
        cosine, sine = np.cos(self.angle_rad), np.sin(self.angle_rad)
        u, v = self.major * np.cos(turns), self.minor * np.sin(turns)
        return np.column_stack([self.x + u * cosine - v * sine, self.y + u * sine + v * cosine])

    def radial_distance(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Signed distances (n,) of points (n, 2), outside positive, along the ray from the centre.

        With p the vector from the centre and q = (p_u/a)² + (p_v/b)² in the ellipse's own axes, the
        ray meets the ellipse at p/sqrt(q), so the distance is |p| (1 - 1/sqrt(q)). It exceeds the
        orthogonal distance by a factor of up to (a² + b²)/(2ab). The centre itself lies -b away.
        Source: Fox et al. (2002), figure 2.
        """
        u, v = self._own_axes(points)
        length = np.sqrt(u * u + v * v)
        u /= self.major
        v /= self.minor
        level = np.sqrt(u * u + v * v)
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = length * (1 - 1 / level)
        return np.asarray(np.where(level > 0, distance, -self.minor))

    def orthogonal_distance(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Signed distances (n,) of points (n, 2), outside positive, to the nearest point.

        With the point (u, v) in the first quadrant of the ellipse's own axes the nearest point is
        (a² u/(t + a²), b² v/(t + b²)), t the greatest root of
        F(t) = (a u/(t + a²))² + (b v/(t + b²))² - 1. F falls and is convex right of -b², so that
        Newton's steps from the left of the root approach it from the left. On the major axis
        nearer to the centre than (a² - b²)/a the term in v is no part of F: there t = -b².
        Source: Eberly (2013), Distance from a point to an ellipse; for the paper's own distance
        see `radial_distance`.
        """
        a, b = 1.0, self.minor / self.major
        u, v = np.abs(self._own_axes(points)) / self.major
        t = np.maximum(b * v - b * b, u - 1.0)
        with np.errstate(divide="ignore", invalid="ignore"):
            for _ in range(_NEWTON_STEPS):
                first, second = (u / (t + a)) ** 2, (b * v / (t + b * b)) ** 2
                step = (first + second - 1) / (2 * (first / (t + a) + second / (t + b * b)))
                step = np.where(np.isfinite(step), step, 0.0)
                t += np.maximum(step, 0.0)
                if not np.any(step > _NEWTON_SETTLED):
                    break
            near_u, near_v = u / (t + a), b * b * v / (t + b * b)
        inner = t + b * b <= _NEWTON_SETTLED
        near_u = np.where(inner, u / (1 - b * b) if b < 1 else 0.0, near_u)
        near_v = np.where(inner, b * np.sqrt(np.clip(1 - near_u**2, 0, None)), near_v)
        distance = self.major * np.hypot(u - near_u, v - near_v)
        return np.asarray(np.where(u**2 + (v / b) ** 2 >= 1, distance, -distance))

    def _own_axes(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (n, 2) from the centre along the major and the minor axis, (2, n)."""
        cosine, sine = np.cos(self.angle_rad), np.sin(self.angle_rad)
        turn = np.array([[cosine, sine], [-sine, cosine]])
        return np.asarray(turn @ (points.T - [[self.x], [self.y]]))


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
    if len(points) < MIN_POINTS:
        return None
    columns = points.T.copy()
    centre = columns.mean(axis=1)
    columns -= centre[:, None]
    scale = float(np.sqrt(np.vdot(columns, columns) / len(points)))
    if scale == 0:
        return None
    x, y = columns / scale
    carrier = np.stack([x * x, x * y, y * y, x, y, np.ones_like(x)])
    scatter = carrier @ carrier.T / len(points)
    # centred and scaled: the linear block is (xx, xy; xy, yy) with xx + yy = 1, apart from the 1
    xx, xy, yy = scatter[0, 5], scatter[1, 5], scatter[2, 5]
    least = (1 - np.hypot(xx - yy, 2 * xy)) / 2
    if least < ON_A_LINE:
        return None
    reduce = -np.linalg.solve(scatter[3:, 3:], scatter[3:, :3])
    system = _CONSTRAINT_INVERSE @ (scatter[:3, :3] + scatter[:3, 3:] @ reduce)
    vectors = np.linalg.eig(system)[1].real
    ellipse_like = 4 * vectors[0] * vectors[2] - vectors[1] ** 2
    best = int(ellipse_like.argmax())
    if not ellipse_like[best] > 0:
        return None
    conic = vectors[:, best]
    return from_conic(np.concatenate([conic, reduce @ conic]), centre, scale)


def from_conic(
    conic: NDArray[np.float64], centre: NDArray[np.float64], scale: float
) -> Ellipse | None:
    """Ellipse of a conic (6,) in x², xy, y², x, y, 1 of points moved by centre and over scale.

    None for a conic that is no ellipse, is flatter than two lines, or is far too large.
    """
    a, b, c, d, e, f = (float(value) for value in conic)
    # the quadratic part [[a, b/2], [b/2, c]] has the eigenvalues mean +- half
    mean, half = (a + c) / 2, float(np.hypot((a - c) / 2, b / 2))
    low, high = mean - half, mean + half
    determinant = a * c - b * b / 4
    if min(abs(low), abs(high)) <= FLATTEST**2 * max(abs(low), abs(high)):
        return None
    x, y = (b * e / 4 - c * d / 2) / determinant, (b * d / 4 - a * e / 2) / determinant
    level = a * x * x + b * x * y + c * y * y - f
    squares = (level / low, level / high)
    if min(squares) <= 0 or max(squares) > LARGEST**2:
        return None
    # the eigenvector of `high` lies at half the angle of (a - c, b)
    angle = float(np.arctan2(b, a - c)) / 2
    if squares[0] > squares[1]:
        angle += np.pi / 2 if angle <= 0 else -np.pi / 2
    major, minor = scale * np.sqrt([max(squares), min(squares)])
    return Ellipse(
        x=float(centre[0] + scale * x),
        y=float(centre[1] + scale * y),
        major=float(major),
        minor=float(minor),
        angle_rad=angle,
    )
