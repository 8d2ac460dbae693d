"""Baselines for the form of rocks: one value for all, the smallest box of what is seen, a fit.

Each is a measure from elsewhere with the column `sphericity_3d`; suites name them by
`function = "validation.peers.forms:NAME"`.
"""

import numpy as np
from numpy.typing import NDArray

import rockshape
from rockshape.ground.plane import Plane, fit_plane
from synth.geometry.min_volume_box import smallest_box
from synth.rocks.truth import maximum_projection_sphericity
from validation.peers.declare import expected_trait

COMMON = 0.75  # median over the scans that were developed on, apollo_sample 1, 3, 4, 7, 8 and 17

Values = dict[str, list[float]]


@expected_trait(sphericity_3d="form")
def one_value(
    image: NDArray[np.float32], labels: NDArray[np.int32], points_m: NDArray[np.float64]
) -> Values:
    """One and the same value for every rock."""
    del image, points_m
    return {"sphericity_3d": [COMMON for _ in np.unique(labels[labels > 0])]}


@expected_trait(sphericity_3d="form")
def visible_box(
    image: NDArray[np.float32], labels: NDArray[np.int32], points_m: NDArray[np.float64]
) -> Values:
    """Smallest box of the visible points and of their feet on the ground's plane."""
    del image
    plane = fit_plane(points_m[labels == 0])
    numbers = np.unique(labels[labels > 0])
    boxes = [visible_half_axes_m(points_m[labels == number], plane) for number in numbers]
    return {"sphericity_3d": [maximum_projection_sphericity(half_axes_m) for half_axes_m in boxes]}


def visible_half_axes_m(points_m: NDArray[np.float64], plane: Plane | None) -> NDArray[np.float64]:
    """Half-axes (3,) of the smallest box of a rock's points (n, 3) and their feet, longest first.

    NaN without a plane or with fewer than four known points.
    """
    seen_m = points_m[np.isfinite(points_m).all(axis=1)]
    if plane is None or len(seen_m) < 4:
        return np.full(3, np.nan)
    feet_m = seen_m - plane.height_m(seen_m)[:, None] * plane.normal
    return smallest_box(np.concatenate([seen_m, feet_m])).half_sides_m


@expected_trait(sphericity_3d="form")
def constrained_ellipsoid(
    image: NDArray[np.float32], labels: NDArray[np.int32], points_m: NDArray[np.float64]
) -> Values:
    """Half-axes of the ellipsoid that touches the outline's rays and rests on the ground."""
    rocks = rockshape.measure(image=image, range_m=points_m, labels=labels)
    fits = {rock.number: rock.ellipsoid for rock in rocks}
    return {
        "sphericity_3d": [
            float("nan")
            if (fit := fits.get(int(number))) is None
            else maximum_projection_sphericity(fit.half_axes_m)
            for number in np.unique(labels[labels > 0])
        ]
    }
