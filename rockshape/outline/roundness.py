"""Wadell's roundness: how round the corners of an outline are beside its largest inscribed circle.

Corners are judged on the outline's form, which is smooth at a fixed share of the rock's size. No
corner is sought: all that bends outward counts by how far it turns, so that nothing jumps where two
corners meet or a ripple comes and goes. What the smoothing does to corners is undone by a curve.
"""

import numpy as np
from numpy.typing import NDArray

from rockshape.outline.form import OutlineForm
from rockshape.outline.inscribed_circle import inscribed_radius

# Wadell's roundness by the bend's share and the form's scale, linear between:
# `python benchmarks/roundness_curve.py`
SHARES = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97, 1.0)
SCALES = (0.12, 0.2, 0.3)
CURVE = (
    (0.019, 0.079, 0.203, 0.321, 0.469, 0.591, 0.698, 0.792, 0.854, 1.0),
    (-0.011, 0.034, 0.079, 0.159, 0.273, 0.415, 0.595, 0.719, 0.823, 1.0),
    (-0.113, -0.038, 0.036, 0.110, 0.144, 0.193, 0.333, 0.497, 0.687, 1.0),
)


def wadell_roundness(form: OutlineForm, free: NDArray[np.bool_] | None = None) -> float:
    """Mean radius of the corners over the radius R of the largest inscribed circle.

    Where a smooth outline bends outward with the curvature k along a length s, the radius

        r = (integral of k ds / integral of k³ ds)^(1/2)

    is that of the root mean square curvature over the turning k ds: of sides that are straight
    between arcs of one radius it is that radius. The variance that pixels give the curvature is
    taken off the mean square, three times since it is a cube over k. Wadell's r / R of the outline
    before it was smoothed is CURVE's at r / R and the form's scale, which was fitted to outlines
    whose roundness is exact. free (n,) says which of the form's points are the rock's own outline;
    all by default. NaN for no inscribed circle and where nothing free bends outward.
    Source: Wadell (1932), Volume, shape, and roundness of rock particles.
    """
    share = bend_share(form, free)
    if not np.isfinite(share):
        return float("nan")
    levels = [np.interp(share, SHARES, values) for values in CURVE]
    return max(0.0, float(np.interp(form.scale, SCALES, levels)))


def bend_share(form: OutlineForm, free: NDArray[np.bool_] | None = None) -> float:
    """Radius of the turning's root mean square curvature over the inscribed circle's, at most 1."""
    outward = np.maximum(form.curvature, 0.0)
    turning = outward * form.lengths * (1.0 if free is None else free)
    radius = inscribed_radius(form.points)
    total = float(turning.sum())
    if not (radius > 0 and total > 0):
        return float("nan")
    square = float(turning @ outward**2) / total - 3 * form.curvature_variance
    return 1.0 if square <= 1 / radius**2 else 1 / (radius * float(np.sqrt(square)))
