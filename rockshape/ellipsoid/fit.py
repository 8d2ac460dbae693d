"""The least-squares ellipsoid of the points seen on a rock."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid.cloud import cloud_of
from rockshape.ellipsoid.descent import descend
from rockshape.ellipsoid.half_axes import Ellipsoid
from rockshape.ellipsoid.radial_cost import Radial

LARGEST = 3.0  # longest half-axis allowed, in sizes of the cloud: a flat face asks for infinity
SMALLEST = 0.02
SKETCH = 400  # points on which the starts compete, before all decide
COMPARED = 0.1  # relative fall of the sum of squares at which a start has shown its worth
SETTLED = 1e-7  # and on all: Newton's next step would gain about the square of it
SKETCHED = 1e-4  # and at which the best of them is taken to all points


@dataclass(frozen=True, eq=False)
class EllipsoidFit:
    """The ellipsoid found and how the search for it ended."""

    ellipsoid: Ellipsoid
    mean_square_m2: float  # D_S / N
    converged: bool
    bounded: bool  # an axis stands at the bound: the points do not determine it


def fit_ellipsoid(points_m: NDArray[np.float64]) -> EllipsoidFit | None:
    """Ellipsoid of nine parameters that minimises D_S, the sum of squared radial distances.

    points_m is (n, 3) in the camera frame, the camera at the origin. Half-axes, centre and attitude
    are found by Levenberg-Marquardt descent with the analytic Jacobian. Several starts behind the
    visible surface compete on a sketch of 400 points, and the lowest descends on all; the paper
    descends the same D_S by Powell's method (`rockshape.ellipsoid.powell`). A half-axis stays
    between 0.02 and 3 times the cloud's radius: a view of one side may not determine the rest, and
    a flat face would send an axis to infinity. `bounded` says so, and such axes are the bound's and
    not the rock's.

    None for fewer than 30 points, or where they lie in one plane.
    Source: Fox et al. (2002), equations 8 and 11; the axes are sorted after the fit.
    """
    cloud = cloud_of(points_m)
    if cloud is None:
        return None
    points = cloud.points
    bounds = (np.log(SMALLEST), np.log(LARGEST))
    # a fixed shuffle's first: every k-th in order would pick columns of the image
    chosen = np.random.default_rng(0).permutation(len(points))[:SKETCH]
    sketch = Radial(np.ascontiguousarray(points[chosen].T))
    distance = float(np.sqrt(cloud.centroid_m @ cloud.centroid_m))
    view = cloud.centroid_m / distance if distance > 0 else cloud.directions[:, 0]
    starts = cloud.starting_states(view)
    runs = [descend(sketch, start, bounds, enough=COMPARED) for start in starts]
    nearest = min(runs, key=lambda run: run.cost).state
    nearest = descend(sketch, nearest, bounds, enough=SKETCHED).state
    best = descend(
        Radial(np.ascontiguousarray(points.T)), nearest, bounds, enough=SETTLED, whole=True
    )
    edge = 1e-9
    return EllipsoidFit(
        ellipsoid=cloud.in_metres(best.state.ellipsoid()),
        mean_square_m2=2 * best.cost / len(points) * cloud.size_m**2,
        converged=best.converged,
        bounded=bool(
            best.state.log_axes.max() >= bounds[1] - edge
            or best.state.log_axes.min() <= bounds[0] + edge
        ),
    )
