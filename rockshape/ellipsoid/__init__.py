"""Ellipsoids of the points seen on a rock: by range alone, and held by silhouette and ground."""

from rockshape.ellipsoid.cloud import MIN_POINTS
from rockshape.ellipsoid.constrained_fit import HeldEllipsoid, Resting, fit_held_ellipsoid
from rockshape.ellipsoid.distance import hausdorff_m, orthogonal_distance_m
from rockshape.ellipsoid.fit import EllipsoidFit, fit_ellipsoid
from rockshape.ellipsoid.half_axes import Ellipsoid
from rockshape.ellipsoid.outliers import fit_without_outliers

__all__ = [
    "MIN_POINTS",
    "Ellipsoid",
    "EllipsoidFit",
    "HeldEllipsoid",
    "Resting",
    "fit_ellipsoid",
    "fit_held_ellipsoid",
    "fit_without_outliers",
    "hausdorff_m",
    "orthogonal_distance_m",
]
