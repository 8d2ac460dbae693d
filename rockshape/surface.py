"""The B-spline surface of the points seen on a rock, and its second derivatives."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.interpolate import BSpline

DEGREE = 3
NET = 10  # vertices of the polygon net along each parameter
FEWEST_POINTS = NET * NET
STIFFNESS = 1e-6  # trace of the roughness penalty against that of the data's normal matrix


@dataclass(frozen=True, eq=False)
class Patch:
    """Points of a rock as a graph over the image: metres across and metres towards the camera."""

    u_m: NDArray[np.float64]  # (n,), along the image's columns
    w_m: NDArray[np.float64]  # (n,), along the image's rows
    height_m: NDArray[np.float64]  # (n,), towards the camera


def view_patch(points_m: NDArray[np.float64]) -> Patch | None:
    """Lay the points, (n, 3) in the camera frame, over the plane that faces the camera.

    The height is measured along the ray to the points' centroid, so that the visible surface is a
    graph; u follows the image's x axis and w its y axis, both in metres. None for no points, and
    for points that lie round the camera itself or right beside it, which no image shows.
    """
    if len(points_m) == 0:
        return None
    centroid = points_m.mean(axis=0)
    distance = np.linalg.norm(centroid)
    if not abs(centroid[0]) < distance:
        return None
    away = centroid / distance
    across = np.array([1.0, 0.0, 0.0]) - away[0] * away
    across /= np.linalg.norm(across)
    down = np.cross(away, across)
    offset = points_m - centroid
    return Patch(u_m=offset @ across, w_m=offset @ down, height_m=-(offset @ away))


@dataclass(frozen=True, eq=False)
class Surface:
    """A B-spline surface Q(u, w) and its second derivatives at the data points."""

    net_m: NDArray[np.float64]  # (NET, NET), heights of the polygon net's vertices
    residual_m: float  # RMS distance of the data from the surface
    second_uu_per_m: NDArray[np.float64]  # (n,)
    second_ww_per_m: NDArray[np.float64]  # (n,)


def fit_surface(patch: Patch) -> Surface | None:
    """Cubic B-spline surface through the heights of a patch, by least squares.

    Clamped uniform knots over the bounding box of the data, a net of 10 x 10 vertices: the paper
    gives neither knots, order nor net. Half-open knot intervals, since closed ones count their
    common ends twice. The rock is no rectangle, so that net cells without data leave the least
    squares of equation 15 undetermined; a roughness penalty with 1e-6 of the data's weight on the
    second derivatives decides there and nowhere else.

    None for fewer points than the net has vertices, or where the patch has no width.
    Source: Fox et al. (2002), equations 12 to 16.
    """
    if len(patch.u_m) < FEWEST_POINTS:
        return None
    u_low, u_size = float(patch.u_m.min()), float(np.ptp(patch.u_m))
    w_low, w_size = float(patch.w_m.min()), float(np.ptp(patch.w_m))
    if u_size == 0 or w_size == 0:
        return None
    u, w = (patch.u_m - u_low) / u_size, (patch.w_m - w_low) / w_size
    along_u, along_w = _basis(u), _basis(w)
    design = _products(along_u, along_w)
    normal = (design.T @ design).toarray()
    normal += STIFFNESS * np.trace(normal) / np.trace(ROUGHNESS) * ROUGHNESS
    net = np.linalg.solve(normal, design.T @ patch.height_m)
    misfit = design @ net - patch.height_m
    return Surface(
        net_m=net.reshape(NET, NET),
        residual_m=float(np.sqrt(np.mean(misfit**2))),
        second_uu_per_m=_products(_second(along_u, u), along_w) @ net / u_size**2,
        second_ww_per_m=_products(along_u, _second(along_w, w)) @ net / w_size**2,
    )


@dataclass(frozen=True, eq=False)
class _Basis:
    """The basis functions that are not zero at each parameter."""

    values: NDArray[np.float64]  # (n, DEGREE + 1)
    first: NDArray[np.int64]  # (n,), the first one's place in the net


def _basis(parameter: NDArray[np.float64]) -> _Basis:
    """Basis functions at parameters (n,) in 0..1; intervals are half-open but for the last."""
    matrix = BSpline.design_matrix(parameter, KNOTS, DEGREE)
    order = DEGREE + 1
    return _Basis(
        values=matrix.data.reshape(-1, order),
        first=matrix.indices.reshape(-1, order)[:, 0].astype(np.int64),
    )


def _second(basis: _Basis, parameter: NDArray[np.float64]) -> _Basis:
    """Second derivatives of the basis functions, in the same places of the net.

    A cubic's second derivative is a spline of degree one on the inner knots whose vertices are
    linear in the cubic's: one derivative takes B_i to k (B_{i+1} - B_i)/(t_{i+k+1} - t_{i+1}).
    """
    lower = BSpline.design_matrix(parameter, KNOTS[2:-2], DEGREE - 2)
    hats = lower.data.reshape(-1, DEGREE - 1)
    blocks = np.stack(
        [SECOND[span : span + DEGREE - 1, span : span + DEGREE + 1] for span in range(NET - DEGREE)]
    )
    return _Basis(values=np.einsum("nj,njk->nk", hats, blocks[basis.first]), first=basis.first)


def _second_derivative() -> NDArray[np.float64]:
    """The matrix (NET - 2, NET) that takes a cubic's net to that of its second derivative."""
    result, knots = np.eye(NET), KNOTS
    for order in (DEGREE, DEGREE - 1):
        span = knots[order + 1 : -1] - knots[1 : -order - 1]
        result = order * np.diff(result, axis=0) / span[:, None]
        knots = knots[1:-1]
    return result


KNOTS = np.concatenate([np.zeros(DEGREE), np.linspace(0, 1, NET - DEGREE + 1), np.ones(DEGREE)])
SECOND = _second_derivative()
# squares of the second derivatives' vertices along both parameters: nothing for a plane
ROUGHNESS = np.kron(SECOND.T @ SECOND, np.eye(NET)) + np.kron(np.eye(NET), SECOND.T @ SECOND)


def _products(along_u: _Basis, along_w: _Basis) -> sp.csr_array:
    """Rows of products of basis functions, one row a data point: sparse (n, NET * NET)."""
    count, order = along_u.values.shape
    values = along_u.values[:, :, None] * along_w.values[:, None, :]
    place = np.arange(order)
    rows = along_u.first[:, None, None] + place[:, None]
    columns = rows * NET + along_w.first[:, None, None] + place
    starts = np.arange(count + 1) * order**2
    return sp.csr_array((values.ravel(), columns.ravel(), starts), shape=(count, NET * NET))
