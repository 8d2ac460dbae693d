"""Form of an outline: what is left of it at one scale, which every robust 2-D measure is read from.

The scale is a fixed share of the rock's size, so that a value depends neither on the size of the
pixels nor on the ripples that a finer picture shows. docs/findings.md has what each choice adds.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rockshape.outline.resample import (
    canonical,
    even_outline,
    fine_attenuation,
    outline_length,
)
from rockshape.outline.trace import signed_area

FORM_SHARE = 0.12  # sigma over the radius of the disc of equal area
LEAST_SIGMA_PX = 1.8  # what pixels ask for: more than the share below 30 px
EVEN_POINTS = 100
_POINTS = 256
_PIXEL_NOISE = 0.048  # of the curvature's variance, times sigma^5 (px); discs of 16 to 120 px


@dataclass(frozen=True, eq=False)
class OutlineForm:
    """Closed outline smoothed by `sigma`, with its curvature, at 256 points.

    Lengths are in the outline's unit, pixels for a mask.
    """

    points: NDArray[np.float64]  # (n, 2), evenly along the outline before it was smoothed
    lengths: NDArray[np.float64]  # (n,), of the smooth outline, that each point stands for
    curvature: NDArray[np.float64]  # (n,), convex positive
    radius: float  # of the disc of equal area
    sigma: float
    curvature_variance: float  # that the staircase of pixels alone makes

    @property
    def scale(self) -> float:
        """Sigma over the radius: 0.12, and more for rocks of few pixels."""
        return self.sigma / self.radius

    @cached_property
    def even_points(self) -> NDArray[np.float64]:
        """Points (100, 2) at equal steps along it."""
        return even_outline(self.points, EVEN_POINTS)


def form_of(
    edge: NDArray[np.float64], *, staircase: bool, share: float = FORM_SHARE
) -> OutlineForm | None:
    """Form of a closed outline (n, 2), the same however it was traced.

    The outline as a function of its length is smoothed by sigma = 0.12 sqrt(A / pi), as
    `smooth_evenly` does, and is differentiated at its harmonics. staircase says that it is the edge
    of pixels: then sigma is at least 1.8 px, and the variance that the steps give the curvature is
    told, 0.048 / sigma^5. None for an outline without area.
    """
    ring = canonical(edge)
    area, length = signed_area(ring), outline_length(ring)
    if not area > 0:
        return None
    radius = float(np.sqrt(area / np.pi))
    sigma = max(share * radius, LEAST_SIGMA_PX if staircase else 0.0)
    even = even_outline(ring, max(_POINTS, len(ring)))
    harmonics = np.fft.fft(even[:, 0] + 1j * even[:, 1]) / len(even)
    kept = np.concatenate([harmonics[: _POINTS // 2], harmonics[-_POINTS // 2 :]])
    wave = np.fft.fftfreq(_POINTS, 1 / _POINTS) * 2 * np.pi / length
    smooth = kept * fine_attenuation(wave * sigma)
    place, first, second = (
        np.fft.ifft(smooth * (1j * wave) ** order) * _POINTS for order in (0, 1, 2)
    )
    speed = np.abs(first)
    return OutlineForm(
        points=np.column_stack([place.real, place.imag]),
        lengths=speed * length / _POINTS,
        curvature=(first.real * second.imag - first.imag * second.real) / speed**3,
        radius=radius,
        sigma=sigma,
        curvature_variance=_PIXEL_NOISE / sigma**5 if staircase else 0.0,
    )
