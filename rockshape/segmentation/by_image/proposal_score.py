"""How likely an outline proposed from the image is that of a rock."""

import cv2
import numpy as np

from rockshape.numerics.arrays import Floats, Mask
from rockshape.segmentation.by_image.proposal_weights import FORM, MIDDLE, SPREAD
from rockshape.segmentation.by_image.star_proposals import RINGS, Stars

CLEAREST = 6.0  # edges above this many of the texture's deviations per pixel are all alike
WEAK = 1.0
RIM_RINGS = 2  # of the inside, which the outline's own edge reaches
STRIP_PX, SHADOW_PX = 4.0, 6.0  # outside the outline, looked at for what was left out


def likelihood(features: Floats) -> Floats:
    """A number for each outline of such features (n, 13): 0 where it is none, 1 where it fits.

    The quadratic form (1, z) FORM (1, z) in the features' deviations z from their middle. It was
    fitted to made scenes (`benchmarks/segmentation_weights.py`), as what the overlap with the best
    rock is from 0 at an intersection over union of 0.3 to 1 at 0.7.
    """
    z = np.insert((features - MIDDLE) / SPREAD, 0, 1.0, axis=1)
    return np.asarray(np.einsum("ni,ij,nj->n", z, FORM, z))


def features_of(stars: Stars) -> Floats:
    """What speaks for each outline, (n, 13).

    Along the outline: mean and lower quartile of the edge's strength, up to 6, the share of it
    that is weak, and roughness. Inside: the shares of cast shadow and of own shade, and but for a
    rim the mean strength of edges and the share like the ground; the logarithm of area, and the
    area's share of its convex hull's. Around: the share of what is unlike the ground, and the width
    of cast shadow. Last, whether its seed was a facet.
    """
    polar, ring = stars.polar, stars.ring
    ends = np.take_along_axis(polar.radius, ring, axis=1)
    strength = np.minimum(polar.edge, CLEAREST)
    border = np.take_along_axis(strength, ring[..., None], axis=2)[..., 0]
    rings = np.arange(RINGS)
    inside = polar.area * (rings <= ring[..., None])
    core = polar.area * (rings < ring[..., None] - RIM_RINGS)
    area = inside.sum(axis=(1, 2))

    def share(part: Floats, value: Mask | Floats) -> Floats:
        return np.asarray((part * value).sum(axis=(1, 2)) / np.maximum(part.sum(axis=(1, 2)), 1e-9))

    around = rings > ring[..., None] + 1
    strip = (around & (polar.radius[:, None] < ends[..., None] + STRIP_PX)).astype(np.float64)
    shadow = around & (polar.radius[:, None] < ends[..., None] + SHADOW_PX) & polar.cast
    jumps = np.abs(np.diff(ends, axis=1, append=ends[:, :1])).mean(axis=1)
    return np.column_stack(
        [
            border.mean(axis=1),
            np.quantile(border, 0.25, axis=1),
            share(inside, polar.cast),
            share(inside, polar.shaded),
            jumps / ends.mean(axis=1),
            share(strip, polar.unlike & ~polar.cast),
            np.log(area),
            _solidity(stars),
            share(core, strength),
            (border < WEAK).mean(axis=1),
            share(core, ~polar.unlike),
            shadow.sum(axis=(1, 2)) / shadow.shape[1],
            polar.facet,
        ]
    )


def _solidity(stars: Stars) -> Floats:
    """Area over that of the convex hull, (n,)."""
    rings = np.stack([stars.x, stars.y], axis=-1).astype(np.float32)
    return np.array(
        [cv2.contourArea(ring) / max(cv2.contourArea(cv2.convexHull(ring)), 1.0) for ring in rings]
    )
