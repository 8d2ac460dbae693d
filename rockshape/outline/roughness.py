"""Roughness of an outline: heights between two scales that are fixed shares of its size."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.outline.form import form_of

FINE_SHARE, COARSE_SHARE = 0.03, 0.08  # sigmas over the radius of the disc of equal area
BEND_SHARE = 0.2  # of the outline whose bends are corners: no ripple is left of it
FLAT_SHARE = 0.5  # of the points, those where that bends least
_PIXEL_VARIANCE = 0.0122  # px², of the heights times the finer sigma (px); ellipses of 80 px and up


@dataclass(frozen=True, eq=False)
class OutlineRoughness:
    """Heights of an outline at one scale over the same outline at a coarser one.

    Lengths are over the radius of the disc of equal area.
    """

    points: NDArray[np.float64]  # (n, 2), of the coarser outline, in the outline's unit
    heights: NDArray[np.float64]  # (n,), along its normals
    bend: NDArray[np.float64]  # (n,), curvature without sign where ripples are gone, 1/unit
    pixel_rms: float  # of the heights that the staircase of pixels alone makes

    def flat_rms(self, own: NDArray[np.bool_]) -> float:
        """RMS of the heights at the flatter half of some points (n,); NaN of none."""
        heights, bend = self.heights[own], self.bend[own]
        if not len(heights):
            return float("nan")
        flat = bend <= np.quantile(bend, FLAT_SHARE)
        return float(np.sqrt(np.mean(heights[flat] ** 2)))


def roughness_of(edge: NDArray[np.float64]) -> OutlineRoughness | None:
    """Heights of a closed edge (n, 2), in pixels, between the two scales.

    Waves of 0.12 to 0.3 radii keep half of their height or more. None for an edge without area.
    """
    fine, coarse, bent = (
        form_of(edge, staircase=False, share=share)
        for share in (FINE_SHARE, COARSE_SHARE, BEND_SHARE)
    )
    if fine is None or coarse is None or bent is None:
        return None
    along = np.roll(coarse.points, -1, axis=0) - np.roll(coarse.points, 1, axis=0)
    normals = np.column_stack([along[:, 1], -along[:, 0]]) / np.hypot(*along.T)[:, None]
    heights = ((fine.points - coarse.points) * normals).sum(axis=1)
    return OutlineRoughness(
        points=coarse.points,
        heights=heights / coarse.radius,
        bend=np.abs(bent.curvature),
        pixel_rms=float(np.sqrt(_PIXEL_VARIANCE / fine.sigma)) / fine.radius,
    )
