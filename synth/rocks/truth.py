"""Truth of a body: half-axes in two senses, sphericity, volume, area and roundness."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from synth.arrays import Floats


@dataclass(frozen=True, eq=False)
class Truth:
    """Truth of one rock; None where the body's family has no such truth."""

    half_axes_box_m: Floats  # (3,), a >= b >= c, half the sides of the smallest enclosing box
    half_axes_inertia_m: Floats  # (3,), a >= b >= c, of the ellipsoid with the same inertia
    volume_m3: float
    area_m2: float | None
    roundness: float | None
    radius_m: float | None = None  # of all edges and corners; None where they have no one radius
    relief_rms_m: float | None = 0.0  # over the smooth form; None where the form is not known
    relief_degrees: tuple[int, int] | None = None  # its band of spherical harmonics

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        self.half_axes_box_m.setflags(write=False)
        self.half_axes_inertia_m.setflags(write=False)

    def scaled(self, factor: float, *, area_m2: float | None) -> Self:
        """Truth of the rock scaled alike in all directions, whose area is given."""
        return replace(
            self,
            half_axes_box_m=factor * self.half_axes_box_m,
            half_axes_inertia_m=factor * self.half_axes_inertia_m,
            volume_m3=factor**3 * self.volume_m3,
            area_m2=area_m2,
        )

    def maximum_projection_sphericity(self) -> float:
        """Maximum projection sphericity (c²/(ab))^(1/3) of the smallest box.

        Source: Sneed and Folk 1958.
        """
        return maximum_projection_sphericity(self.half_axes_box_m)

    def maximum_projection_sphericity_inertia(self) -> float:
        """Maximum projection sphericity (c²/(ab))^(1/3) of the ellipsoid with the same inertia."""
        return maximum_projection_sphericity(self.half_axes_inertia_m)

    def krumbein_sphericity(self) -> float:
        """Intercept sphericity (bc/a²)^(1/3) of the smallest box.

        Source: Krumbein 1941.
        """
        longest, middle, shortest = self.half_axes_box_m
        return float(np.cbrt(middle * shortest / longest**2))

    def wadell_sphericity(self) -> float | None:
        """Wadell sphericity π^(1/3) (6V)^(2/3) / S; None where the area has no truth.

        Source: Wadell 1932.
        """
        if self.area_m2 is None:
            return None
        return float(np.cbrt(np.pi * (6.0 * self.volume_m3) ** 2) / self.area_m2)


def maximum_projection_sphericity(half_axes_m: Floats) -> float:
    """Maximum projection sphericity (c²/(ab))^(1/3) of half-axes a >= b >= c.

    Source: Sneed and Folk 1958.
    """
    longest, middle, shortest = half_axes_m
    return float(np.cbrt(shortest**2 / (longest * middle)))


def half_axes_of_covariance_m(covariance_m2: Floats) -> Floats:
    """Half-axes a >= b >= c, (3,), of the solid ellipsoid with these second moments: √(5 λ)."""
    return np.asarray(np.sqrt(5.0 * np.linalg.eigvalsh(covariance_m2)[::-1]))
