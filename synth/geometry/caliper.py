"""Caliper half-axes of points: greatest extents at right angles to one another."""

import numpy as np
from scipy.spatial import ConvexHull

from synth.arrays import Floats
from synth.geometry.min_volume_box import spread_directions

_STARTS = 64  # directions in which a longest chord is sought first
_BLOCK = 512  # points whose distances to all others are taken at once


def caliper_half_axes_m(points_m: Floats, *, margin_m: float = 0.0) -> Floats:
    """Caliper half-axes L >= I >= S, (3,), of the hull of points (n, 3) thickened by a margin.

    L is half the longest chord, I half the greatest extent across it, S half the extent across
    both; an extent is the distance of two parallel planes that hold the body between them. The
    margin adds to each, as it does to any extent of P ⊕ B_r. Exact for the points, but for ties:
    of chords of one length any may be taken, and I and S go with it.

    Raises:
        QhullError: the points lie in a plane.

    Source: Sneed and Folk 1958, with I across L as on the maximum projection plane.
    """
    return np.asarray(_calipers_m(points_m)[1] / 2.0 + margin_m)


def caliper_axes(points_m: Floats, *, hull: ConvexHull | None = None) -> Floats:
    """Directions of L, I and S, rows of (3, 3), of the hull of points (n, 3), made if not given.

    Raises:
        QhullError: the points lie in a plane.
    """
    return _calipers_m(points_m, hull)[0]


def _calipers_m(points_m: Floats, hull: ConvexHull | None = None) -> tuple[Floats, Floats]:
    """Directions of the extents at right angles, rows of (3, 3), and their lengths (3,)."""
    corners_m = points_m[(hull or ConvexHull(points_m)).vertices]
    along = _longest_chord_m(corners_m)
    longest_m = float(np.linalg.norm(along))
    first = along / longest_m
    second = np.cross(first, np.eye(3)[np.argmin(np.abs(first))])
    second /= np.linalg.norm(second)
    across = np.stack([second, np.cross(first, second)])
    flat_m = corners_m @ across.T
    chord = _longest_chord_m(flat_m[ConvexHull(flat_m).vertices])
    middle_m = float(np.linalg.norm(chord))
    turned = np.stack([chord, [-chord[1], chord[0]]]) / middle_m
    lengths_m = np.array([longest_m, middle_m, float(np.ptp(flat_m @ turned[1]))])
    return np.concatenate([first[None], turned @ across]), lengths_m


def _longest_chord_m(points_m: Floats) -> Floats:
    """Vector between the two points (n, 2 or 3) that are farthest apart.

    A long chord is found by turns: the farthest points along a direction give the next. A point
    that even the farthest from the middle could not put farther than that is then left out, and
    the rest are tried in pairs.
    """
    points_m = points_m - (points_m.min(axis=0) + points_m.max(axis=0)) / 2.0
    radii_m = np.linalg.norm(points_m, axis=1)
    found_m = _climbed_m(points_m)
    kept_m = points_m[radii_m + radii_m.max() >= found_m * (1.0 - 1e-12)]
    best_m2, best = 0.0, kept_m[0]
    squares_m2 = (kept_m**2).sum(axis=1)
    for start in range(0, len(kept_m), _BLOCK):
        block_m = kept_m[start : start + _BLOCK]
        gaps_m2 = squares_m2[start : start + _BLOCK, None] + squares_m2 - 2.0 * block_m @ kept_m.T
        one, two = np.unravel_index(np.argmax(gaps_m2), gaps_m2.shape)
        if gaps_m2[one, two] > best_m2:
            best_m2, best = float(gaps_m2[one, two]), block_m[one] - kept_m[two]
    return np.asarray(best)


def _climbed_m(points_m: Floats) -> float:
    """Length of a chord that no turn towards its own ends makes longer."""
    directions = spread_directions(_STARTS)[:, : points_m.shape[1]]
    longest_m = 0.0
    while True:
        along = directions @ points_m.T
        chords_m = points_m[along.argmax(axis=1)] - points_m[along.argmin(axis=1)]
        lengths_m = np.linalg.norm(chords_m, axis=1)
        if lengths_m.max() <= longest_m:
            return longest_m
        longest_m = float(lengths_m.max())
        directions = chords_m[lengths_m > 0.99 * longest_m]
