"""Refinement of the views' poses: trimmed point-to-plane alignment of all views at once."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from rockshape.errors import InputError
from rockshape.fusion.patches import Patches, patches, rock_size_m
from rockshape.fusion.pose import CameraPose
from rockshape.fusion.posed_view import PosedView
from rockshape.numerics.robust_scale import MEDIAN_TO_SIGMA

ROUNDS = 20
MAX_POINTS = 1500  # of a view, to be paired with another's
REACH = 3.0  # of the expected errors at the rocks: how far apart patches are paired at first
SHRINK = 0.8  # of the reach from one round to the next
LEAST_REACH = 0.25
LIKE = 0.8  # cosine between normals of patches that are one
CUT = 2.5  # standard deviations, from which a pair has no weight
LEAST_SD = 0.1  # of the reach: least standard deviation of residuals
SETTLED_M = 1e-5  # largest move of a round that ends the search
EXPECTED_TURN_DEG = 0.5  # of a pose's error about each axis, which damps the search
EXPECTED_SHIFT_M = 0.01
ALIKE = 8.0  # pairs of patches that tell as much as one, since neighbours err together
MAX_TURN_DEG = 3.0
MAX_SHIFT_M = 0.1


@dataclass(frozen=True, eq=False)
class Alignment:
    """Poses as refined, and how far each moved."""

    poses: tuple[CameraPose, ...]
    turned_deg: tuple[float, ...]
    shifted_m: tuple[float, ...]  # of the camera's place


def align(views: Sequence[PosedView]) -> Alignment:
    """Poses under which the surfaces that several views see agree best.

    Every patch of a view is paired with the nearest of every other view, if it is near and faces
    the same way, and

        sum w (n . (p - q))² / (8 σ²) + sum |turn|²/(0.5°)² + |shift|²/(1 cm)²

    is minimised over all poses, round by round, with Tukey's weights w and the residuals' robust
    standard deviation σ, at least a tenth of how far pairs may lie apart, which shrinks. What no
    pair of patches tells stays nearly as it was given. Pairs lie apart by at most three times the
    expected error of a place at first: a pose that is farther off may find none and stay.
    Raises: InputError where a pose moves by more than 3° or 10 cm, which is no small error.
    Source: Chen and Medioni (1992), Object modelling by registration of multiple range images.
    """
    size_m = rock_size_m(tuple(views))
    start = [view.pose for view in views]
    poses = list(start)
    if len(views) > 1 and np.isfinite(size_m):
        seen = [patches(view, size_m=size_m) for view in views]
        poses = _refined(start, seen, _expected_m(views))
    turned = tuple(_turn_deg(a, b) for a, b in zip(start, poses, strict=True))
    shifted = tuple(
        float(np.linalg.norm(b.position_m - a.position_m))
        for a, b in zip(start, poses, strict=True)
    )
    for view, turn_deg, shift_m in zip(views, turned, shifted, strict=True):
        if turn_deg > MAX_TURN_DEG or shift_m > MAX_SHIFT_M:
            raise InputError(
                f"{view.name}: expected a pose within {MAX_TURN_DEG:g}° and "
                f"{100 * MAX_SHIFT_M:g} cm of where its range fits the other views', "
                f"found {turn_deg:.2g}° and {100 * shift_m:.2g} cm"
            )
    return Alignment(tuple(poses), turned, shifted)


def _expected_m(views: Sequence[PosedView]) -> float:
    """Expected error of a rock's place: of a pose's shift, and of its turn at that distance."""
    distances = [np.linalg.norm(rock.points_m[0]) for view in views for rock in view.rocks]
    return EXPECTED_SHIFT_M + float(np.deg2rad(EXPECTED_TURN_DEG) * np.median(distances))


def _refined(
    start: Sequence[CameraPose], seen: Sequence[Patches], expected_m: float
) -> list[CameraPose]:
    """Poses after rounds of pairing and solving; patches are given in the world of the start."""
    poses, now = list(start), list(seen)
    reach = REACH
    for _ in range(ROUNDS):
        pairs = [
            _paired(i, j, now[i], now[j], reach * expected_m)
            for i in range(len(now))
            for j in range(len(now))
            if i != j
        ]
        step = _step(pairs, start, poses, least_sd_m=LEAST_SD * reach * expected_m)
        if step is None:
            break
        moved = 0.0
        for view, (turn, shift) in enumerate(step.reshape(-1, 2, 3)):
            rotation = Rotation.from_rotvec(turn).as_matrix()
            place = poses[view].position_m
            poses[view] = CameraPose(rotation @ poses[view].camera_to_world, place + shift)
            points = (now[view].points_m - place) @ rotation.T
            moved = max(moved, float(np.abs(points + place + shift - now[view].points_m).max()))
            now[view] = Patches(points + place + shift, now[view].normals @ rotation.T)
        if reach <= LEAST_REACH and moved < SETTLED_M:
            break
        reach = max(LEAST_REACH, SHRINK * reach)
    return poses


@dataclass(frozen=True, eq=False)
class _Pairs:
    """Pairs of patches of two views."""

    views: tuple[int, int]
    points_m: tuple[NDArray[np.float64], NDArray[np.float64]]  # (n, 3) each
    normals: NDArray[np.float64]  # (n, 3), of the second
    residual_m: NDArray[np.float64]  # (n,)


def _paired(i: int, j: int, mine: Patches, other: Patches, reach_m: float) -> _Pairs:
    """Patches of one view and the nearest of the other that face the same way."""
    if not len(mine.points_m) or not len(other.points_m):
        none = np.empty((0, 3))
        return _Pairs((i, j), (none, none), none, np.empty(0))
    step = max(1, len(mine.points_m) // MAX_POINTS)
    points, normals = mine.points_m[::step], mine.normals[::step]
    distance, near = cKDTree(other.points_m).query(points, distance_upper_bound=reach_m)
    met = np.flatnonzero(np.isfinite(distance))
    met = met[(normals[met] * other.normals[near[met]]).sum(axis=1) > LIKE]
    p, q, n = points[met], other.points_m[near[met]], other.normals[near[met]]
    return _Pairs((i, j), (p, q), n, ((p - q) * n).sum(axis=1))


def _step(
    pairs: Sequence[_Pairs],
    start: Sequence[CameraPose],
    poses: Sequence[CameraPose],
    *,
    least_sd_m: float,
) -> NDArray[np.float64] | None:
    """Turn and shift of every view, (6 views,), about its camera; None without pairs."""
    residuals = np.concatenate([pair.residual_m for pair in pairs])
    if not len(residuals):
        return None
    scale_m = max(MEDIAN_TO_SIGMA * float(np.median(np.abs(residuals))), least_sd_m)
    size = 6 * len(poses)
    left, right = np.zeros((size, size)), np.zeros(size)
    for pair in pairs:
        weight = np.maximum(0.0, 1.0 - (pair.residual_m / (CUT * scale_m)) ** 2) ** 2
        weight /= ALIKE * scale_m**2
        jacobian = np.zeros((len(pair.residual_m), size))
        for sign, view, points in zip((1.0, -1.0), pair.views, pair.points_m, strict=True):
            arm = points - poses[view].position_m
            jacobian[:, 6 * view : 6 * view + 3] = sign * np.cross(arm, pair.normals)
            jacobian[:, 6 * view + 3 : 6 * view + 6] = sign * pair.normals
        left += jacobian.T @ (weight[:, None] * jacobian)
        right -= jacobian.T @ (weight * pair.residual_m)
    prior = np.repeat([np.deg2rad(EXPECTED_TURN_DEG), EXPECTED_SHIFT_M], 3) ** -2.0
    for view, (given, pose) in enumerate(zip(start, poses, strict=True)):
        turn = Rotation.from_matrix(pose.camera_to_world @ given.camera_to_world.T).as_rotvec()
        gone = np.concatenate([turn, pose.position_m - given.position_m])
        own = slice(6 * view, 6 * view + 6)
        left[own, own] += np.diag(prior)
        right[own] -= prior * gone
    return np.asarray(np.linalg.solve(left, right))


def _turn_deg(one: CameraPose, other: CameraPose) -> float:
    turn = Rotation.from_matrix(other.camera_to_world @ one.camera_to_world.T)
    return float(np.rad2deg(turn.magnitude()))
