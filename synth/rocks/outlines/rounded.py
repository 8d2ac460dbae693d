"""Outlines of P ⊕ B_r: rounded polygons, exact."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull

from synth.arrays import Floats
from synth.geometry.caliper import caliper_half_axes_m
from synth.geometry.inscribed_ball import largest_ball
from synth.rocks.outlines.record import OutlineTruth, axis_ratio

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)  # exact to rounding on arcs up to π


@dataclass(frozen=True, eq=False)
class RoundedHull:
    """Rounded hull: the points within a radius of a convex polyhedron."""

    vertices_m: Floats  # (n, 3), of the polyhedron
    radius_m: float

    def __post_init__(self) -> None:
        """Make the array read-only."""
        self.vertices_m.setflags(write=False)

    def moved(self, rotation: Floats, translation_m: Floats) -> "RoundedHull":
        """Body turned by a rotation (3, 3), then shifted by a translation (3,)."""
        return RoundedHull(self.vertices_m @ rotation.T + translation_m, self.radius_m)

    def caliper_half_axes_m(self) -> Floats:
        """Caliper half-axes L >= I >= S, (3,), exact."""
        return caliper_half_axes_m(self.vertices_m, margin_m=self.radius_m)

    def outline(self, across: Floats) -> OutlineTruth:
        """Outline Q ⊕ disc, with Q the hull of the projected vertices.

        A projection of a Minkowski sum is the sum of the projections. So the area is
        A₀ + L₀r + πr², the perimeter L₀ + 2πr (Steiner), and every corner has the radius r:
        Wadell's roundness is r/(r_in + r).
        """
        hull = ConvexHull(self.vertices_m @ across.T)
        corners_m = hull.points[hull.vertices]
        edges_m = np.roll(corners_m, -1, axis=0) - corners_m
        lengths_m = np.linalg.norm(edges_m, axis=1)
        normals = np.column_stack([edges_m[:, 1], -edges_m[:, 0]]) / lengths_m[:, None]
        offsets_m = np.einsum("ij,ij->i", normals, corners_m)
        inradius_m = largest_ball(normals, offsets_m).radius_m
        length_m, r = float(lengths_m.sum()), self.radius_m
        return OutlineTruth(
            area_m2=float(offsets_m @ lengths_m / 2.0) + length_m * r + np.pi * r**2,
            perimeter_m=length_m + 2.0 * np.pi * r,
            axis_ratio=axis_ratio(_covariance_m2(corners_m, normals, r)),
            roundness=r / (inradius_m + r),
        )


def _covariance_m2(corners_m: Floats, normals: Floats, radius_m: float) -> Floats:
    """Second central moments of Q ⊕ disc over its area, (2, 2), by Gauss and Green.

    With outward normal n, ∫ x xᵀ dA = ∮ x xᵀ (x·n) ds / 4 and ∫ x dA = ∮ x (x·n) ds / 3: Euler's
    theorem on homogeneous functions, with the divergence theorem.
    """
    starts_m = corners_m + radius_m * normals  # of the straight pieces
    spans_m = np.roll(corners_m, -1, axis=0) - corners_m
    share = (_NODES + 1.0) / 2.0
    straight_m = starts_m[:, None] + share[:, None] * spans_m[:, None]
    steps_m = np.linalg.norm(spans_m, axis=1)[:, None] * _WEIGHTS / 2.0
    bearing_rad = np.arctan2(normals[:, 1], normals[:, 0])
    before_rad = np.roll(bearing_rad, 1)
    turn_rad = (bearing_rad - before_rad) % (2.0 * np.pi)
    along_rad = before_rad[:, None] + turn_rad[:, None] * share
    arms = np.stack([np.cos(along_rad), np.sin(along_rad)], axis=-1)
    points_m = np.concatenate([straight_m, corners_m[:, None] + radius_m * arms]).reshape(-1, 2)
    outward = np.concatenate([np.repeat(normals, len(share), axis=0), arms.reshape(-1, 2)])
    arc_steps_m = radius_m * turn_rad[:, None] * _WEIGHTS / 2.0
    weights_m2 = np.concatenate([steps_m, arc_steps_m]).ravel() * np.einsum(
        "ij,ij->i", points_m, outward
    )
    area_m2 = weights_m2.sum() / 2.0
    centre_m = weights_m2 @ points_m / (3.0 * area_m2)
    squares = np.einsum("n,ni,nj->ij", weights_m2, points_m, points_m) / (4.0 * area_m2)
    return np.asarray(squares - np.outer(centre_m, centre_m))
