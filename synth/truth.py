"""What is true of a body: half-axes in two senses, sphericity, volume, area and roundness."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

Floats = NDArray[np.float64]

_MAX_NORMALS = 64  # hull facets tried as a side of the box
_TURNS = 60  # turns tried about each normal, over a right angle
_STARTS = 4  # best candidates that are refined
_FIRST_REACH_RAD, _LAST_REACH_RAD = 0.03, 1e-8
_GRID = np.stack(np.meshgrid(*[[-1.0, 0.0, 1.0]] * 3), axis=-1).reshape(-1, 3)
_DIRECTIONS = np.array([turn / np.linalg.norm(turn) for turn in _GRID if turn.any()])  # (26, 3)


@dataclass(frozen=True, eq=False)
class Truth:
    """What is true of one rock; None where the body's family has no such truth."""

    half_axes_box_m: Floats  # (3,), a >= b >= c, half the sides of the smallest enclosing box
    half_axes_inertia_m: Floats  # (3,), a >= b >= c, of the ellipsoid with the same inertia
    volume_m3: float
    area_m2: float | None
    roundness: float | None

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        self.half_axes_box_m.setflags(write=False)
        self.half_axes_inertia_m.setflags(write=False)

    def maximum_projection_sphericity(self) -> float:
        """Return (c²/(ab))^(1/3) of the smallest box (Sneed and Folk 1958)."""
        return maximum_projection_sphericity(self.half_axes_box_m)

    def maximum_projection_sphericity_inertia(self) -> float:
        """Return (c²/(ab))^(1/3) of the ellipsoid with the same inertia."""
        return maximum_projection_sphericity(self.half_axes_inertia_m)

    def wadell_sphericity(self) -> float | None:
        """Return π^(1/3) (6V)^(2/3) / S (Wadell 1932), or None where the area has no truth."""
        if self.area_m2 is None:
            return None
        return float(np.cbrt(np.pi * (6.0 * self.volume_m3) ** 2) / self.area_m2)


@dataclass(frozen=True, eq=False)
class Box:
    """A box round points: its rows of axes match its half sides."""

    axes: Floats  # (3, 3), a rotation; rows are the directions of the sides, longest first
    half_sides_m: Floats  # (3,), longest first
    centre_m: Floats  # (3,)


def maximum_projection_sphericity(half_axes_m: Floats) -> float:
    """Return (c²/(ab))^(1/3) of half-axes a >= b >= c (Sneed and Folk 1958)."""
    longest, middle, shortest = half_axes_m
    return float(np.cbrt(shortest**2 / (longest * middle)))


def half_axes_of_covariance_m(covariance_m2: Floats) -> Floats:
    """Return a >= b >= c, (3,), of the solid ellipsoid with these second moments: √(5 λ)."""
    return np.asarray(np.sqrt(5.0 * np.linalg.eigvalsh(covariance_m2)[::-1]))


def smallest_box(points_m: Floats, *, margin_m: float = 0.0) -> Box:
    """Return the box of least volume round points (n, 3), each thickened to a ball of the margin.

    Sides flush with a facet of the convex hull, and the principal axes, are tried first; the best
    are refined by a simplex search over rotations, since the optimum need not be flush with any
    facet (O'Rourke 1985). The half sides of P ⊕ B_r along u are those of P plus r, exactly.
    Flat or fewer than four points raise scipy's QhullError.
    """
    hull = ConvexHull(points_m)
    corners_m = points_m[hull.vertices]
    frames = _candidate_frames(hull, corners_m)
    volumes = _box_volumes(frames, corners_m, margin_m)
    found = [
        _refined(frames[index], corners_m, margin_m) for index in np.argsort(volumes)[:_STARTS]
    ]
    return _box(min(found, key=lambda pair: pair[0])[1], corners_m, margin_m)


def nearby_box(points_m: Floats, *, margin_m: float = 0.0) -> Box:
    """Return the box of least volume among those that are little turned from the axes."""
    return _box(_refined(np.eye(3), points_m, margin_m)[1], points_m, margin_m)


def _box(axes: Floats, points_m: Floats, margin_m: float) -> Box:
    """Return the box along the given axes, its sides in falling order."""
    low, high = _extents(axes, points_m)
    half_sides_m = (high - low) / 2.0 + margin_m
    order = np.argsort(-half_sides_m, kind="stable")
    rows = axes[order]
    if np.linalg.det(rows) < 0:
        rows = rows * np.array([[1.0], [1.0], [-1.0]])
    return Box(axes=rows, half_sides_m=half_sides_m[order], centre_m=axes.T @ ((low + high) / 2.0))


def _candidate_frames(hull: ConvexHull, corners_m: Floats) -> Floats:
    """Return rotations, (k, 3, 3), worth trying as a box's axes."""
    normals = np.unique(hull.equations[:, :3].round(9), axis=0)
    chosen = normals[np.linspace(0, len(normals) - 1, min(len(normals), _MAX_NORMALS)).astype(int)]
    principal = np.linalg.eigh(np.cov(corners_m.T))[1].T
    normals = np.concatenate([chosen, principal])
    helper = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    second = np.cross(normals, helper)
    second /= np.linalg.norm(second, axis=1, keepdims=True)
    third = np.cross(normals, second)
    turns_rad = np.arange(_TURNS) * (np.pi / 2.0 / _TURNS)
    cosine, sine = np.cos(turns_rad)[:, None], np.sin(turns_rad)[:, None]
    first_axes = cosine * second[:, None] + sine * third[:, None]
    second_axes = cosine * third[:, None] - sine * second[:, None]
    third_axes = np.broadcast_to(normals[:, None], first_axes.shape)
    return np.stack([first_axes, second_axes, third_axes], axis=2).reshape(-1, 3, 3)


def _extents(axes: Floats, points_m: Floats) -> tuple[Floats, Floats]:
    """Return the least and greatest coordinates of points along axes (..., 3, 3)."""
    along = axes @ points_m.T
    return along.min(axis=-1), along.max(axis=-1)


def _box_volumes(axes: Floats, points_m: Floats, margin_m: float) -> Floats:
    """Return the volumes of the boxes along axes (..., 3, 3)."""
    low, high = _extents(axes, points_m)
    return np.asarray(np.prod(high - low + 2.0 * margin_m, axis=-1))


def _refined(axes: Floats, points_m: Floats, margin_m: float) -> tuple[float, Floats]:
    """Return the least volume and its axes near the given ones, by a shrinking pattern search.

    The volume has creases, so no gradient is used: turns of one length about 26 directions are
    tried at once, the best is taken, and the length is halved when none is better.
    """
    volume = float(_box_volumes(axes, points_m, margin_m))
    reach_rad = _FIRST_REACH_RAD
    while reach_rad > _LAST_REACH_RAD:
        turned = Rotation.from_rotvec(reach_rad * _DIRECTIONS).as_matrix() @ axes
        volumes = _box_volumes(turned, points_m, margin_m)
        best = int(np.argmin(volumes))
        if volumes[best] < volume:
            volume, axes = float(volumes[best]), turned[best]
        else:
            reach_rad /= 2.0
    return volume, axes
