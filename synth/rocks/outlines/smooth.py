"""Outlines of ellipsoids and superellipsoids."""

from dataclasses import dataclass

import numpy as np
from scipy.special import ellipe

from synth.arrays import Floats
from synth.geometry.min_volume_box import spread_directions
from synth.rocks.outlines.record import OutlineTruth, plane_across, polygon_outline

_STARTS, _TURNS = 64, 200  # of the search for the greatest radius
DIRECTIONS = 8192  # tangents of a superellipsoid's outline; half as many move it by < 1e-3


@dataclass(frozen=True, eq=False)
class EllipsoidForm:
    """Ellipsoid along the axes."""

    half_axes_m: Floats  # (3,)

    def caliper_half_axes_m(self) -> Floats:
        """Caliper half-axes: an ellipsoid's own."""
        return np.sort(self.half_axes_m)[::-1].copy()

    def outline(self, across: Floats) -> OutlineTruth:
        """Outline, an ellipse p >= q: A = πpq, L = 4pE(1 − q²/p²), exact.

        Its two corners have the radius of curvature q²/p, its inscribed disc q: roundness q/p.
        """
        short_m, long_m = np.sqrt(np.linalg.eigvalsh((across * self.half_axes_m**2) @ across.T))
        return OutlineTruth(
            area_m2=float(np.pi * short_m * long_m),
            perimeter_m=float(4.0 * long_m * ellipe(1.0 - (short_m / long_m) ** 2)),
            axis_ratio=float(short_m / long_m),
            roundness=float(short_m / long_m),
        )


@dataclass(frozen=True, eq=False)
class SuperellipsoidForm:
    """Superellipsoid (|x/a|^p + |y/b|^p)^(q/p) + |z/c|^q <= 1 with p, q >= 2."""

    half_axes_m: Floats  # (3,)
    exponents: tuple[float, float]  # p, round the z axis; q, towards it

    def caliper_half_axes_m(self) -> Floats:
        """Caliper half-axes L >= I >= S, (3,).

        The body is symmetric about its middle: L is its greatest radius x, where the normal's
        contact point lies on the normal, I the greatest of the support function across x.
        """
        radii = spread_directions(_STARTS)
        for _ in range(_TURNS):
            radii = self.contact_m(radii / np.linalg.norm(radii, axis=1, keepdims=True))
        lengths_m = np.linalg.norm(radii, axis=1)
        first = radii[np.argmax(lengths_m)] / lengths_m.max()
        turn_rad = np.pi * np.arange(DIRECTIONS) / DIRECTIONS
        around = np.column_stack([np.cos(turn_rad), np.sin(turn_rad)]) @ plane_across(first)
        extents_m = np.einsum("ij,ij->i", self.contact_m(around), around)
        best = int(np.argmax(extents_m))
        shortest_m = extents_m[(best + DIRECTIONS // 2) % DIRECTIONS]
        return np.array([lengths_m.max(), extents_m[best], shortest_m])

    def contact_m(self, directions: Floats) -> Floats:
        """Points (n, 3) of the surface whose outward normals are given, (n, 3).

        They are the gradient of the support function
        h(u) = ((|au|^P + |bv|^P)^(Q/P) + |cw|^Q)^(1/Q) with P = p/(p − 1), Q = q/(q − 1).
        """
        level, steep = (value / (value - 1.0) for value in self.exponents)
        scaled = directions * self.half_axes_m
        size = np.abs(scaled)
        radius = (size[:, :2] ** level).sum(axis=1) ** (1.0 / level)
        support = (radius**steep + size[:, 2] ** steep) ** (1.0 / steep)
        safe = np.maximum(radius, 1e-300)[:, None]
        ring = radius[:, None] ** (steep - 1.0) * (size[:, :2] / safe) ** (level - 1.0)
        gradient = np.column_stack([ring, size[:, 2] ** (steep - 1.0)])
        return np.asarray(
            self.half_axes_m * np.sign(scaled) * gradient / support[:, None] ** (steep - 1.0)
        )

    def outline(self, across: Floats, *, directions: int = DIRECTIONS) -> OutlineTruth:
        """Outline through the contact points of many tangents, all on it.

        Corners are the places of least radius of curvature dL/dθ that is less than the inscribed
        disc's radius; the outline is symmetric about its middle, so that disc's radius is the
        least of the support function (Wadell 1932).
        """
        turn_rad = 2.0 * np.pi * (np.arange(directions) + 0.5) / directions
        bearings = np.column_stack([np.cos(turn_rad), np.sin(turn_rad)])
        points_m = self.contact_m(bearings @ across) @ across.T
        inscribed_m = float(np.einsum("ij,ij->i", points_m, bearings).min())
        chords_m = np.linalg.norm(np.roll(points_m, -1, axis=0) - points_m, axis=1)
        radii_m = chords_m * directions / (2.0 * np.pi)
        dips = (radii_m < np.roll(radii_m, 1)) & (radii_m <= np.roll(radii_m, -1))
        dips &= radii_m < inscribed_m * (1.0 - 1e-6)
        roundness = float(radii_m[dips].mean() / inscribed_m) if dips.any() else 1.0
        return polygon_outline(points_m, roundness=roundness)
