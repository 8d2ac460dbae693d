"""The paper's own search: Powell's method on the nine parameters of equation 11.

It needs scipy.optimize, which nothing else here imports, and many times the time of
`fit_ellipsoid`, which descends the same D_S to the same minimum.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from rockshape.ellipsoid.cloud import cloud_of
from rockshape.ellipsoid.distance import hausdorff_m
from rockshape.ellipsoid.fit import EllipsoidFit
from rockshape.ellipsoid.half_axes import Ellipsoid

HAUSDORFF_SAMPLES = 512  # of the surface while searching


@dataclass(frozen=True)
class PowellFit:
    """The ellipsoid that Powell's method ended at."""

    ellipsoid: Ellipsoid
    distance: float  # D_S / N in m², or D_H in m
    converged: bool
    evaluations: int  # of the distance


def fit_by_powell(
    points_m: NDArray[np.float64],
    *,
    distance: Literal["square", "hausdorff"] = "square",
    tolerance: float = 1e-8,
    near: EllipsoidFit | None = None,
) -> PowellFit | None:
    """Descend D_S (`square`) or D_H (`hausdorff`) of points (n, 3) by Powell's method.

    Parameters are a, b, c as logarithms, the centre and the angles of R1, R2, R3. The start is the
    cloud's own axes with the centre behind the surface, or `near`. scipy stops where a round of
    nine line searches gains less than `tolerance` of the distance; at its default of 1e-4 it stops
    up to some per cent above the minimum of D_S.

    None where `fit_ellipsoid` gives None for want of points or extent.
    Source: Fox et al. (2002), equations 8 to 11.
    """
    cloud = cloud_of(points_m)
    if cloud is None:
        return None
    points = cloud.points
    if near is None:
        view = cloud.centroid_m / max(float(np.linalg.norm(cloud.centroid_m)), 1e-300)
        start = cloud.starting_states(view)[1].ellipsoid()
    else:
        start = cloud.scaled(near.ellipsoid)
    columns = np.ascontiguousarray(points.T)
    base = start.axes.T  # the angles turn the start's axes, away from the poles of R1 R2 R3

    def square(parameters: NDArray[np.float64]) -> float:
        own = (base @ paper_rotation(parameters[6:])).T @ (columns - parameters[3:6, None])
        own *= own
        length = np.sqrt(own.sum(axis=0))
        distance = length - length / np.sqrt(np.exp(-2 * parameters[:3]) @ own)
        return float(distance @ distance) / len(points)

    def hausdorff(parameters: NDArray[np.float64]) -> float:
        return hausdorff_m(unpack(parameters), points, samples=HAUSDORFF_SAMPLES)

    def unpack(parameters: NDArray[np.float64]) -> Ellipsoid:
        order = np.argsort(-parameters[:3], kind="stable")
        return Ellipsoid(
            centre_m=parameters[3:6],
            half_axes_m=np.exp(parameters[order]),
            axes=(base @ paper_rotation(parameters[6:])).T[order],
        )

    result = minimize(
        square if distance == "square" else hausdorff,
        np.concatenate([np.log(start.half_axes_m), start.centre_m, np.zeros(3)]),
        method="Powell",
        options={"xtol": tolerance, "ftol": tolerance, "maxiter": 2000, "maxfev": 400_000},
    )
    return PowellFit(
        ellipsoid=cloud.in_metres(unpack(result.x)),
        distance=float(result.fun) * cloud.size_m ** (2 if distance == "square" else 1),
        converged=bool(result.success),
        evaluations=int(result.nfev),
    )


def paper_rotation(angles_rad: NDArray[np.float64]) -> NDArray[np.float64]:
    """R1 R2 R3 (3, 3) of equation 11, by angles (3,) about z, y and x.

    R1 is printed with the other handedness than R2 and R3; their product is a rotation all the
    same.
    """
    (c1, c2, c3), (s1, s2, s3) = np.cos(angles_rad), np.sin(angles_rad)
    about_z = np.array([[c1, s1, 0], [-s1, c1, 0], [0, 0, 1]])
    about_y = np.array([[c2, 0, s2], [0, 1, 0], [-s2, 0, c2]])
    about_x = np.array([[1, 0, 0], [0, c3, -s3], [0, s3, c3]])
    return np.asarray(about_z @ about_y @ about_x)
