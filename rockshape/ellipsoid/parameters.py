"""The nine parameters of an ellipsoid while they are searched."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid.half_axes import Ellipsoid

Bounds = tuple[float, float]  # of the log half-axes


@dataclass(frozen=True, eq=False)
class State:
    """An ellipsoid with its axes in no order.

    A step (9,) is (shift of the centre in own axes, changes of the log half-axes, rotation vector
    in own axes).
    """

    centre: NDArray[np.float64]  # (3,)
    log_axes: NDArray[np.float64]  # (3,)
    rotation: NDArray[np.float64]  # (3, 3), own axes in columns

    def moved(self, step: NDArray[np.float64], bounds: Bounds) -> "State":
        """The state a step leads to; no half-axis changes by more than a factor e at once."""
        log_axes = self.log_axes + np.minimum(np.maximum(step[3:6], -1.0), 1.0)
        return State(
            centre=self.centre + self.rotation @ step[:3],
            log_axes=np.minimum(np.maximum(log_axes, bounds[0]), bounds[1]),
            rotation=self.rotation @ turn(step[6:]),
        )

    def ellipsoid(self) -> Ellipsoid:
        """The ellipsoid, its axes sorted."""
        order = np.argsort(-self.log_axes, kind="stable")
        return Ellipsoid(
            centre_m=self.centre,
            half_axes_m=np.exp(self.log_axes[order]),
            axes=np.ascontiguousarray(self.rotation[:, order].T),
        )


def turn(vector: NDArray[np.float64]) -> NDArray[np.float64]:
    """The rotation (3, 3) by a rotation vector (3,) in radians: Rodrigues' formula."""
    angle = float(np.sqrt(vector @ vector))
    cross = np.array(
        [[0.0, -vector[2], vector[1]], [vector[2], 0.0, -vector[0]], [-vector[1], vector[0], 0.0]]
    )
    # sin x / x and (1 - cos x)/x², whose series end at double precision below 1e-4
    if angle < 1e-4:
        first, second = 1 - angle**2 / 6, 0.5 - angle**2 / 24
    else:
        first, second = np.sin(angle) / angle, (1 - np.cos(angle)) / angle**2
    return np.asarray(np.eye(3) + first * cross + second * (cross @ cross))
