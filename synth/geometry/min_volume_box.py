"""Minimum-volume bounding box of points."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from synth.arrays import Floats
from synth.geometry.vectors import perpendicular

_MAX_NORMALS = 48  # hull facets tried as a side of the box
_TURNS = 30  # turns tried about each normal, over a right angle
_STARTS = 4  # best candidates, each of another normal, that are refined
_SPREAD, _MORE_STARTS = 64, 16  # directions tried, and refined, where facets are many and small
_CLEARLY = 1e-6  # by which share theirs must be better: not a turn of the same box
_HOPE = 10.0  # of the volume, for a turn: a search that is farther than this behind is given up
_COARSE = 300  # directions whose farthest points stand for all in the first trials
_FIRST_REACH_RAD, _HALVINGS = 0.03, 21  # down to 1.4e-8 rad
_GRID = np.stack(np.meshgrid(*[[-1.0, 0.0, 1.0]] * 3), axis=-1).reshape(-1, 3)
_DIRECTIONS = np.array([turn / np.linalg.norm(turn) for turn in _GRID if turn.any()])  # (26, 3)
_FEW, _AT_ONCE = 64, 80  # points of which none is left out; points times lengths tried at once
_REACHES_RAD = _FIRST_REACH_RAD / 2.0 ** np.arange(_HALVINGS + 1)
_TURNED = np.stack(
    [Rotation.from_rotvec(reach * _DIRECTIONS).as_matrix() for reach in _REACHES_RAD]
)  # (reaches, 26, 3, 3)


@dataclass(frozen=True, eq=False)
class Box:
    """Bounding box: its rows of axes match its half sides."""

    axes: Floats  # (3, 3), a rotation; rows are the directions of the sides, longest first
    half_sides_m: Floats  # (3,), longest first
    centre_m: Floats  # (3,)


def smallest_box(points_m: Floats, *, margin_m: float = 0.0, hull: ConvexHull | None = None) -> Box:
    """Box of least volume round points (n, 3), each thickened to a ball of the margin.

    Sides flush with a facet of the convex hull, and the principal axes, are tried first; the best
    are refined by a search over rotations, since the optimum need not be flush with any facet
    (O'Rourke 1985). Of a rough body's many facets only some are tried, so directions all over the
    sphere are tried as well. The half sides of P ⊕ B_r along u are those of P plus r, exactly.
    The points' hull is made where it is not given. Flat or fewer than four points raise scipy's
    QhullError.
    """
    hull = hull or ConvexHull(points_m)
    corners_m = points_m[hull.vertices]
    few_m = _thinned(corners_m)
    facets = np.unique(hull.equations[:, :3].round(9), axis=0)
    tried = np.linspace(0, len(facets) - 1, min(len(facets), _MAX_NORMALS)).astype(int)
    normals = np.concatenate([facets[tried], np.linalg.eigh(np.cov(few_m.T))[1].T])
    starts = _starts(normals, few_m, margin_m)[:_STARTS]
    found = [_refined(axes, corners_m, margin_m) for axes in starts]
    least, best = min(found, key=lambda pair: pair[0])
    if len(facets) > _MAX_NORMALS:
        spread = spread_directions(2 * _SPREAD)[:_SPREAD]  # its upper half
        for axes in _starts(spread, few_m, margin_m)[:_MORE_STARTS]:
            volume, turned = _refined(axes, corners_m, margin_m, least=least)
            if volume < least * (1.0 - _CLEARLY):
                least, best = volume, turned
    return box_along(best, corners_m, margin_m)


def nearby_box(points_m: Floats, *, margin_m: float = 0.0) -> Box:
    """Box of least volume among those that are little turned from the axes."""
    return box_along(_refined(np.eye(3), points_m, margin_m)[1], points_m, margin_m)


def box_along(axes: Floats, points_m: Floats, margin_m: float = 0.0) -> Box:
    """Box along the given axes, rows of a rotation (3, 3), its sides in falling order."""
    along = axes @ points_m.T
    low, high = along.min(axis=-1), along.max(axis=-1)
    half_sides_m = (high - low) / 2.0 + margin_m
    order = np.argsort(-half_sides_m, kind="stable")
    rows = axes[order]
    if np.linalg.det(rows) < 0:
        rows = rows * np.array([[1.0], [1.0], [-1.0]])
    return Box(axes=rows, half_sides_m=half_sides_m[order], centre_m=axes.T @ ((low + high) / 2.0))


def _thinned(corners_m: Floats) -> Floats:
    """Points that are farthest along a few hundred directions, all of fewer points."""
    if len(corners_m) <= _COARSE:
        return corners_m
    farthest = np.argmax(spread_directions(_COARSE) @ corners_m.T, axis=1)
    return np.asarray(corners_m[np.unique(farthest)])


def _starts(normals: Floats, corners_m: Floats, margin_m: float) -> Floats:
    """Best turn about each normal, (k, 3, 3) rotations, smallest box first."""
    normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    second, third = perpendicular(normals)
    turns_rad = np.arange(2 * _TURNS) * (np.pi / 2.0 / _TURNS)
    across = np.stack([second @ corners_m.T, third @ corners_m.T], axis=1)  # (k, 2, n)
    along = np.column_stack([np.cos(turns_rad), np.sin(turns_rad)]) @ across  # (k, turns, n)
    widths_m = np.ptp(along, axis=2) + 2.0 * margin_m
    heights_m = np.ptp(normals @ corners_m.T, axis=1) + 2.0 * margin_m
    volumes = widths_m[:, :_TURNS] * widths_m[:, _TURNS:] * heights_m[:, None]
    best_turns = np.argmin(volumes, axis=1)
    order = np.argsort(volumes.min(axis=1), kind="stable")
    turn_rad = turns_rad[best_turns[order]][:, None]
    first = np.cos(turn_rad) * second[order] + np.sin(turn_rad) * third[order]
    return np.stack([first, np.cross(normals[order], first), normals[order]], axis=1)


def spread_directions(count: int) -> Floats:
    """Unit vectors, (count, 3), evenly over the sphere (a Fibonacci lattice)."""
    index = np.arange(count) + 0.5
    height = 1.0 - 2.0 * index / count
    azimuth_rad = np.pi * (1.0 + np.sqrt(5.0)) * index
    level = np.sqrt(1.0 - height**2)
    return np.column_stack([level * np.cos(azimuth_rad), level * np.sin(azimuth_rad), height])


def _refined(
    axes: Floats, points_m: Floats, margin_m: float, *, least: float = np.inf
) -> tuple[float, Floats]:
    """Least volume and its axes near the given ones, by a shrinking pattern search.

    A search that cannot be expected to come below `least` any more is broken off.

    The volume has creases, so no gradient is used: turns of one length about 26 directions are
    tried at once, the best is taken, and the length is halved when none is better. Of few points
    the next lengths are tried along with it.
    """
    arms_m = points_m - points_m.mean(axis=0)
    reach_m = float(np.sqrt((arms_m**2).sum(axis=1).max()))
    volume = float(np.prod(np.ptp(axes @ arms_m.T, axis=1) + 2.0 * margin_m))
    level = 0
    while level <= _HALVINGS and _hopeful(volume, least, level):
        outer_m = _outer_m(arms_m, axes, 2.0 * _REACHES_RAD[level] * reach_m)
        turned = _TURNED[level : level + max(1, _AT_ONCE // len(outer_m))] @ axes
        trial = outer_m @ turned.reshape(-1, 3).T  # (points, lengths × 26 × 3)
        sides_m = trial.max(axis=0) - trial.min(axis=0) + 2.0 * margin_m
        volumes = sides_m.reshape(-1, 26, 3).prod(axis=2)
        for tried, best in zip(volumes, volumes.argmin(axis=1), strict=True):
            if tried[best] < volume:
                volume, axes = float(tried[best]), _TURNED[level, best] @ axes
                break
            level += 1
            if level > _HALVINGS or not _hopeful(volume, least, level):
                break
    return volume, axes


def _hopeful(volume: float, least: float, level: int) -> bool:
    """Whether turns of this length may bring a volume below another."""
    return bool(volume <= least * (1.0 + _HOPE * _REACHES_RAD[level]))


def _outer_m(arms_m: Floats, axes: Floats, slack_m: float) -> Floats:
    """Points, out of (n, 3), that may touch a box when it is turned a little; few points are kept.

    A turn by ε moves a point by no more than ε times its distance from the middle, so points
    farther than that inside the six sides are left out.
    """
    if len(arms_m) <= _FEW:
        return arms_m
    along = axes @ arms_m.T
    outer = (along >= along.max(axis=1, keepdims=True) - slack_m).any(axis=0)
    outer |= (along <= along.min(axis=1, keepdims=True) + slack_m).any(axis=0)
    return np.asarray(arms_m[outer])
