"""Robust cost of an ellipsoid held by range, silhouette and ground, with its derivatives."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid.parameters import State
from rockshape.ellipsoid.residuals import (
    Linearised,
    lowest_point,
    points_to_surface,
    rays_to_silhouette,
)

SKETCH = 4  # the starts compete on every fourth point and ray
ROUGH = 0.08  # of the rock's size: standard deviation of rocks from ellipsoids
GIVE_UP = 3.0  # standard deviations at which a residual weighs a quarter
SHARE_POINTS, SHARE_RAYS, SHARE_GROUND = 3.0, 1.0, 0.1


@dataclass(frozen=True, eq=False)
class ConstrainedCost:
    """Half the robust sum of squares of range, silhouette and ground; lengths over the size."""

    points: NDArray[np.float64]  # (3, n)
    point_sd: NDArray[np.float64]  # (n,)
    rays: NDArray[np.float64]  # (3, m)
    eye: NDArray[np.float64]  # (3,), where the rays begin
    normal: NDArray[np.float64] | None  # (3,)
    offset: float
    last: list[tuple[State, list[Linearised]]] = field(default_factory=list)

    def _seen(self, state: State) -> list[Linearised]:
        """Residuals of range and silhouette, in the order of `spread` and `share`.

        The last state's are kept: a step is tried before it is taken.
        """
        if not self.last or self.last[0][0] is not state:
            seen = [points_to_surface(self.points, state)]
            if self.rays.shape[1]:
                seen.append(rays_to_silhouette(self.rays, self.eye, state))
            self.last[:] = [(state, seen)]
        return self.last[0][1]

    @cached_property
    def spread(self) -> NDArray[np.float64]:
        """The residual (n + m,) at which each weighs a quarter."""
        return GIVE_UP * np.append(self.point_sd, np.full(self.rays.shape[1], ROUGH))

    @cached_property
    def share(self) -> NDArray[np.float64]:
        """What each residual (n + m,) counts in the cost."""
        counts = self.points.shape[1], self.rays.shape[1]
        shares = SHARE_POINTS / counts[0], SHARE_RAYS / max(counts[1], 1)
        return np.repeat(shares, counts)

    def cost(self, state: State) -> float:
        """Half the sum of the robust squares."""
        square = np.concatenate([part.residuals for part in self._seen(state)])
        square /= self.spread
        square *= square
        total = float(self.share @ (square / (1 + square)))
        if self.normal is not None:
            over = float(lowest_point(self.normal, state).residuals[0]) - self.offset
            level = (over / (GIVE_UP * ROUGH)) ** 2
            total += SHARE_GROUND * level / (1 + level)
        return GIVE_UP**2 * total / 2

    def derivatives(
        self, state: State, *, whole: bool
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Gradient (9,) and Gauss-Newton matrix (9, 9), each residual with its present weight.

        There is no whole Hessian: the ends the three kinds hold leave little for J^T J to miss.
        """
        del whole
        seen = self._seen(state)
        residuals = np.concatenate([part.residuals for part in seen])
        jacobian = np.concatenate([part.jacobian for part in seen], axis=1)
        weight = self.share * _trust(residuals, self.spread)
        gradient = jacobian @ (weight * residuals)
        system = (jacobian * weight) @ jacobian.T
        if self.normal is not None:
            low = lowest_point(self.normal, state)
            over, slope = low.residuals - self.offset, low.jacobian[:, 0]
            pull = float(SHARE_GROUND * _trust(over, GIVE_UP * ROUGH)[0])
            gradient += pull * float(over[0]) * slope
            system += pull * np.outer(slope, slope)
        return gradient, system

    def sketch(self) -> "ConstrainedCost":
        """The same on fewer points and rays."""
        return ConstrainedCost(
            points=np.ascontiguousarray(self.points[:, ::SKETCH]),
            point_sd=self.point_sd[::SKETCH],
            rays=np.ascontiguousarray(self.rays[:, ::SKETCH]),
            eye=self.eye,
            normal=self.normal,
            offset=self.offset,
        )


def _trust(
    residuals: NDArray[np.float64], spread: NDArray[np.float64] | float
) -> NDArray[np.float64]:
    """The weight (n,) of each residual: L'(x)/(2x)/σ², where the spread is 3σ."""
    level = residuals / spread
    return np.asarray((GIVE_UP / (spread * (1 + level * level))) ** 2)
