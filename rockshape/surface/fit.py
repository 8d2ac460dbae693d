"""The B-spline surface of the points seen on a rock, and its second derivatives."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rockshape.surface.basis import Knots, evaluate
from rockshape.surface.gcv import best_smoothing
from rockshape.surface.normal_equations import (
    Net,
    bending,
    factorise,
    normal_equations,
    rows,
    vertex_bending,
)
from rockshape.surface.patch import SurfacePatch

NET = Net(u=Knots(10), w=Knots(10))
MIN_POINTS = NET.size
STIFFNESS = 1e-6  # trace of the roughness penalty against that of the data's normal matrix

Smoothing = float | Literal["slight", "gcv"]


@dataclass(frozen=True, eq=False)
class Surface:
    """A B-spline surface Q(u, w) over a rectangle, and its second derivatives at the data.

    With u and w normalised to 0..1 as in the paper the second derivatives are u_size_m² times
    `second_uu_per_m` and w_size_m² times `second_ww_per_m`, in metres.
    """

    net: Net
    vertices_m: NDArray[np.float64]  # (net.u.count, net.w.count), heights of the polygon net
    low_m: tuple[float, float]  # u and w where the net begins
    size_m: tuple[float, float]  # of the net along u and w
    smoothing_m: float  # the length l of the penalty; NaN for `slight`
    residual_m: float  # RMS distance of the data from the surface
    second_uu_per_m: NDArray[np.float64]  # (n,)
    second_ww_per_m: NDArray[np.float64]  # (n,)

    def derivative(
        self,
        u_m: NDArray[np.float64],
        w_m: NDArray[np.float64],
        *,
        along_u: int = 0,
        along_w: int = 0,
    ) -> NDArray[np.float64]:
        """The surface's height, or a derivative of it, at places (n,) of the rectangle.

        Metres to the power 1 - along_u - along_w. Places beyond the rectangle get its border's.
        """
        u = np.clip((u_m - self.low_m[0]) / self.size_m[0], 0, 1)
        w = np.clip((w_m - self.low_m[1]) / self.size_m[1], 0, 1)
        data = rows(
            self.net,
            evaluate(self.net.u, u, derivative=along_u),
            evaluate(self.net.w, w, derivative=along_w),
        )
        scale = self.size_m[0] ** along_u * self.size_m[1] ** along_w
        return data.at(self.vertices_m.ravel()) / scale


def fit_surface(
    patch: SurfacePatch,
    *,
    net: Net = NET,
    smoothing: Smoothing = "slight",
    weights: NDArray[np.float64] | None = None,
) -> Surface | None:
    """B-spline surface through the heights of a patch, by (penalised) least squares.

    Clamped uniform knots over the bounding box of the data, by default cubic with a net of 10 x 10
    vertices: the paper gives neither knots, order nor net. With C the products of the basis
    functions the vertices are B = (C^T C + P)^-1 C^T D. P is:

    - 0 for `smoothing=0`, equation 15 to the letter. The rock is no rectangle, and net cells
      without data leave that undetermined: None.
    - `slight`: the squares of the second derivatives' vertices, with 1e-6 of the data's weight; it
      decides where no datum does and nowhere else.
    - for a length l in metres: n l⁴ times the mean of Q_uu² + 2 Q_uw² + Q_ww² over the rectangle,
      so that waves shorter than about 2 pi l are flattened.
    - `gcv`: the l of least generalised cross-validation, n RSS/(n - tr H)², H from data to
      surface (Craven and Wahba 1979). It takes neighbours' errors for independent; those of a
      stereo matcher are not, and are then followed as if they were relief.

    The work is of the order n orders⁴ + size band², nothing of n size. weights (n,) are the data's.

    None for fewer points than the net has vertices, where the patch has no width, or where the
    system is undetermined.
    Source: Fox et al. (2002), equations 12 to 16.
    """
    if len(patch.u_m) < net.size:
        return None
    u_low, u_size = float(patch.u_m.min()), float(np.ptp(patch.u_m))
    w_low, w_size = float(patch.w_m.min()), float(np.ptp(patch.w_m))
    if u_size == 0 or w_size == 0:
        return None
    u, w = (patch.u_m - u_low) / u_size, (patch.w_m - w_low) / w_size
    along_u, along_w = evaluate(net.u, u), evaluate(net.w, w)
    data = rows(net, along_u, along_w)
    bands, side = normal_equations(data, patch.height_m, weights)
    length = float("nan")
    if smoothing == "slight":
        penalty = vertex_bending(net)
        bands = bands + STIFFNESS * bands[0].sum() / penalty[0].sum() * penalty
    elif smoothing != 0:
        penalty = bending(net, u_size, w_size)
        total = float(len(u) if weights is None else weights.sum())
        if smoothing == "gcv":
            square = patch.height_m**2
            energy = float(square.sum() if weights is None else weights @ square)
            length = best_smoothing(bands, side, penalty, energy=energy, count=total)
        else:
            length = float(smoothing)
        bands = bands + total * length**4 * penalty
    else:
        length = 0.0
    factor = factorise(bands)
    if factor is None:
        return None
    vertices = factor.solve(side)
    misfit = data.at(vertices) - patch.height_m
    second_u, second_w = evaluate(net.u, u, derivative=2), evaluate(net.w, w, derivative=2)
    return Surface(
        net=net,
        vertices_m=vertices.reshape(net.u.count, net.w.count),
        low_m=(u_low, w_low),
        size_m=(u_size, w_size),
        smoothing_m=length,
        residual_m=float(np.sqrt(np.mean(misfit**2))),
        second_uu_per_m=data.like(second_u, along_w).at(vertices) / u_size**2,
        second_ww_per_m=data.like(along_u, second_w).at(vertices) / w_size**2,
    )
