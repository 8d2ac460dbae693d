"""B-spline basis functions on clamped uniform knots, and their derivatives."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Knots:
    """Clamped uniform knots over 0..1: `order` equal ones at each end, the others evenly between.

    `count` vertices need count >= order; order 4 is cubic.
    """

    count: int  # vertices of the polygon net along this parameter
    order: int = 4

    @property
    def spans(self) -> int:
        """Number of knot intervals that are not empty."""
        return self.count - self.order + 1

    def values(self) -> NDArray[np.float64]:
        """The knots, (count + order,)."""
        ends = self.order - 1
        inner = np.linspace(0.0, 1.0, self.spans + 1)
        return np.concatenate([np.zeros(ends), inner, np.ones(ends)])


@dataclass(frozen=True, eq=False)
class Basis:
    """The basis functions that are not zero at each parameter."""

    values: NDArray[np.float64]  # (order, n)
    span: NDArray[np.intp]  # (n,), the knot interval, and the first function's place in the net


def evaluate(knots: Knots, parameter: NDArray[np.float64], *, derivative: int = 0) -> Basis:
    """Basis functions, or their derivatives, at parameters (n,) in 0..1.

    N_{i,1} = 1 for x_i <= t < x_{i+1}, and
    N_{i,k} = (t - x_i) N_{i,k-1}/(x_{i+k-1} - x_i) + (x_{i+k} - t) N_{i+1,k-1}/(x_{i+k} - x_{i+1}).
    The intervals are half-open, the last one closed: those of the paper, closed at both ends, count
    their common ends twice. A derivative takes N_{i,k} to
    (k - 1) (N_{i,k-1}/(x_{i+k-1} - x_i) - N_{i+1,k-1}/(x_{i+k} - x_{i+1})).

    Source: Fox et al. (2002), after equation 12 (Cox and de Boor).
    """
    place, order = knots.values(), knots.order
    span = np.minimum((parameter * knots.spans).astype(np.intp), knots.spans - 1)
    # the product's rounding may leave a parameter that is a knot in the interval before it
    span += (parameter >= place[span + order]) & (span < knots.spans - 1)
    values = np.ones((1, len(parameter)))
    start = span + order - 1  # of the interval among all knots
    for degree in range(1, order):
        raising = degree < order - derivative
        grown = np.zeros((degree + 1, len(parameter)))
        for j in range(degree):
            left, right = place[start + 1 - degree + j], place[start + 1 + j]
            share = values[j] / (right - left)
            if raising:
                grown[j] += (right - parameter) * share
                grown[j + 1] += (parameter - left) * share
            else:
                grown[j] -= degree * share
                grown[j + 1] += degree * share
        values = grown
    return Basis(values=values, span=span)


@lru_cache(maxsize=64)
def derivative_net(knots: Knots, derivative: int) -> NDArray[np.float64]:
    """The matrix (count - derivative, count) from a net to that of the curve's derivative."""
    result, place, order = np.eye(knots.count), knots.values(), knots.order
    for degree in range(order - 1, order - 1 - derivative, -1):
        width = place[degree + 1 : -1] - place[1 : -degree - 1]
        result = degree * np.diff(result, axis=0) / width[:, None]
        place = place[1:-1]
    result.setflags(write=False)
    return result


@lru_cache(maxsize=64)
def overlaps(knots: Knots, derivative: int) -> NDArray[np.float64]:
    """Integrals (count, count) over 0..1 of products of basis functions' derivatives, exact.

    Gauss and Legendre's points, as many in each interval as the order.
    """
    nodes, weights = np.polynomial.legendre.leggauss(knots.order)
    place = (np.arange(knots.spans)[:, None] + (nodes + 1) / 2).ravel() / knots.spans
    basis = evaluate(knots, place, derivative=derivative)
    rows = np.zeros((len(place), knots.count))
    places = basis.span[:, None] + np.arange(knots.order)
    np.put_along_axis(rows, places, basis.values.T, axis=1)
    result = (rows * np.tile(weights / 2 / knots.spans, knots.spans)[:, None]).T @ rows
    result.setflags(write=False)
    return np.asarray(result)
