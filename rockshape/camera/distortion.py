"""Lens distortion: between the plane of an ideal pinhole and what the lens makes of it.

Points are (n, 2) as (X/Z, Y/Z).
"""

from dataclasses import dataclass
from typing import Protocol

import cv2
import numpy as np

from rockshape.numerics.arrays import Floats

IDENTITY = np.eye(3)
ITERATIONS = 20  # of Newton's method, quadratic, at most
STEP = 1e-5
TOLERANCE = 1e-7


class Distortion(Protocol):
    """Model of a lens's distortion."""

    def distort(self, ideal: Floats) -> Floats:
        """Where the lens shows points (n, 2) of the ideal plane."""

    def undistort(self, seen: Floats) -> Floats:
        """Points (n, 2) of the ideal plane that the lens shows; NaN where there are none."""


@dataclass(frozen=True)
class BrownConrady:
    """Radial, tangential, rational, thin-prism and tilt terms in OpenCV's order.

    Source: Brown (1966), Conrady (1919); OpenCV, camera calibration, `k1 k2 p1 p2 k3 ...`.
    """

    coefficients: tuple[float, ...]  # 4, 5, 8, 12 or 14

    def distort(self, ideal: Floats) -> Floats:
        """Where the lens shows points of the ideal plane."""
        points = np.column_stack([ideal, np.ones(len(ideal))])
        none = np.zeros(3)
        seen = cv2.projectPoints(points, none, none, IDENTITY, np.array(self.coefficients))[0]
        return np.asarray(seen.reshape(-1, 2))

    def undistort(self, seen: Floats) -> Floats:
        """Points of the ideal plane that the lens shows, by Newton's iteration."""
        return newton_inverse(self, seen)


@dataclass(frozen=True)
class InverseBrownConrady:
    """Brown and Conrady's terms that map what the lens shows to the ideal plane.

    Source: librealsense, `RS2_DISTORTION_INVERSE_BROWN_CONRADY`.
    """

    coefficients: tuple[float, ...]

    def distort(self, ideal: Floats) -> Floats:
        """Where the lens shows points of the ideal plane, by iteration."""
        return BrownConrady(self.coefficients).undistort(ideal)

    def undistort(self, seen: Floats) -> Floats:
        """Points of the ideal plane that the lens shows."""
        return BrownConrady(self.coefficients).distort(seen)


@dataclass(frozen=True)
class Fisheye:
    """Equidistant projection with a polynomial in the angle.

    Source: Kannala and Brandt (2006), equation 6; OpenCV's fisheye model, `k1 k2 k3 k4`.
    """

    coefficients: tuple[float, float, float, float]

    def distort(self, ideal: Floats) -> Floats:
        """Where the lens shows points of the ideal plane."""
        radius = np.sqrt((ideal**2).sum(axis=1))
        angle = np.arctan(radius)
        return ideal * _ratio(_odd_polynomial(angle, self.coefficients), radius)[:, None]

    def undistort(self, seen: Floats) -> Floats:
        """Points of the ideal plane that the lens shows, by Newton's iteration."""
        radius = np.sqrt((seen**2).sum(axis=1))
        slope = np.polynomial.Polynomial([1, *np.multiply(self.coefficients, (3, 5, 7, 9))])
        angle = radius.copy()
        for _ in range(ITERATIONS):
            angle -= (_odd_polynomial(angle, self.coefficients) - radius) / slope(angle**2)
        angle = np.where(np.abs(angle) < np.pi / 2, angle, np.nan)
        return _inverses(self, seen * _ratio(np.tan(angle), radius)[:, None], seen)


def _odd_polynomial(angle: Floats, coefficients: tuple[float, ...]) -> Floats:
    """Polynomial t (1 + k1 t² + k2 t⁴ + ...)."""
    return np.asarray(angle * np.polynomial.Polynomial([1, *coefficients])(angle**2))


def _ratio(numerator: Floats, denominator: Floats) -> Floats:
    """Quotient; 1 at the axis, where both vanish."""
    at_axis = denominator < 1e-12
    return np.where(at_axis, 1.0, numerator / np.where(at_axis, 1.0, denominator))


def newton_inverse(model: Distortion, seen: Floats) -> Floats:
    """Ideal points (n, 2) of seen ones by Newton's iteration; NaN where it does not get there."""
    ideal = seen.copy()
    with np.errstate(all="ignore"):
        for _ in range(ITERATIONS):
            miss = model.distort(ideal) - seen
            if not (np.abs(miss) > TOLERANCE / 100).any():
                break
            along, down = (
                (model.distort(ideal + step) - model.distort(ideal - step)) / (2 * STEP)
                for step in STEP * np.eye(2)
            )
            area = along[:, 0] * down[:, 1] - along[:, 1] * down[:, 0]
            ideal[:, 0] -= (miss[:, 0] * down[:, 1] - miss[:, 1] * down[:, 0]) / area
            ideal[:, 1] -= (along[:, 0] * miss[:, 1] - along[:, 1] * miss[:, 0]) / area
            ideal[~(area > 0)] = np.nan  # beyond where the lens folds its image
    return _inverses(model, ideal, seen)


def _inverses(model: Distortion, ideal: Floats, seen: Floats) -> Floats:
    """Ideal points that the lens does show where it was asked for; NaN for the others."""
    misses = np.abs(model.distort(np.nan_to_num(ideal)) - seen).max(axis=1)
    return np.where((misses < TOLERANCE)[:, None], ideal, np.nan)
