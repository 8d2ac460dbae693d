"""Outlines proposed from the image: star-shaped, each the cheapest closed path round a seed."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray

from rockshape.numerics.arrays import Floats, Mask
from rockshape.segmentation.by_image.ground_appearance import CAST, GROUND, SHADED, Lightness
from rockshape.segmentation.by_image.proposal_seeds import find_seeds
from rockshape.segmentation.edges.shortest_path import closed_paths

RAYS, RINGS = 64, 48
REACH, EXTRA_PX = 1.8, 8.0  # a rock ends within so many radii of its seed, and so many pixels
GROUND_INSIDE = 0.12  # price of a pixel inside that looks like ground,
CAST_INSIDE = 0.6  # that is a cast shadow,
OTHER_INSIDE = 0.1  # that is unlike the ground but not of the seed,
OUT_OF_FRAME = 0.3
SEED_OUTSIDE = (1.0, 0.1)  # and of a pixel near the seed left outside; of a whole, of a facet
EDGE_PX = (2.5, 6.0)  # an edge as strong as the texture is worth so many pixels of ground inside
STRONGEST = 3.0
BEND = 0.25
AT_ONCE = 400  # seeds; OpenCV's sampling takes up to 32,767 rows
OVERLAP = 16


@dataclass(frozen=True, eq=False)
class Polar:
    """What lies along the rays from the seeds; (n, rays, rings) unless said."""

    radius: Floats  # (n, rings), px
    step: Floats  # (n,), between rings, px
    area: Floats  # (n, 1, rings), of a cell
    edge: Floats  # in deviations of the texture per pixel
    unlike: Mask
    cast: Mask
    shaded: Mask
    inside: Mask  # the frame
    facet: Mask  # (n,), the seed is one


@dataclass(frozen=True, eq=False)
class Stars:
    """Outlines proposed, and what lies within and around each."""

    x: Floats  # (n, rays), px
    y: Floats  # (n, rays), px
    ring: NDArray[np.intp]  # (n, rays), on which the outline lies
    polar: Polar


def propose(lightness: Lightness, *, taken: NDArray[np.generic]) -> Iterator[Stars]:
    """Outlines round all seeds whose middle is not taken (rows, cols), in parts; 0 is not.

    In polar coordinates about a seed the path minimises, over its inside, the price of pixels that
    look like ground or cast shadow, over its outside the price of the seed's own, less the strength
    of the edges it follows. Round a facet, which may be one of several rocks that touch, edges
    count more and what is left outside less.
    """
    seeds = find_seeds(lightness, taken=taken)
    for first in range(0, len(seeds), AT_ONCE):
        yield _trace(lightness, seeds[first : first + AT_ONCE])


def _trace(lightness: Lightness, seeds: Floats) -> Stars:
    turns = np.arange(RAYS) * 2 * np.pi / RAYS
    polar = _unroll(lightness, seeds, turns)
    reach = seeds[:, 2]
    own = polar.unlike & ~polar.cast & (polar.radius <= reach[:, None])[:, None]
    other = polar.unlike & ~polar.cast & ~own
    price = (
        GROUND_INSIDE * ~polar.unlike
        + CAST_INSIDE * polar.cast
        + OTHER_INSIDE * other
        + OUT_OF_FRAME * ~polar.inside
    ) * polar.area
    inner = np.cumsum(price, axis=2) - price
    seed_outside, edge_px = (
        np.array(pair)[polar.facet.astype(int)] for pair in (SEED_OUTSIDE, EDGE_PX)
    )
    left_out = np.cumsum((own * polar.area)[..., ::-1], axis=2)[..., ::-1]
    arc = (polar.radius * 2 * np.pi / RAYS)[:, None]
    gain = GROUND_INSIDE * np.minimum(polar.edge, STRONGEST) * arc
    scale = (reach * 2 * np.pi / RAYS * GROUND_INSIDE)[:, None, None]
    cost = inner + seed_outside[:, None, None] * left_out - edge_px[:, None, None] * gain
    bend = (BEND * polar.step / GROUND_INSIDE).astype(np.float32)
    path = np.stack(
        closed_paths(list((cost / scale).astype(np.float32)), bend=bend, overlap=OVERLAP)
    )
    ends = np.take_along_axis(polar.radius, path, axis=1)
    return Stars(
        x=seeds[:, :1] + np.cos(turns) * ends,
        y=seeds[:, 1:2] + np.sin(turns) * ends,
        ring=path,
        polar=polar,
    )


def _unroll(lightness: Lightness, seeds: Floats, turns: Floats) -> Polar:
    rows, cols = lightness.light.shape
    step = (REACH * seeds[:, 2] + EXTRA_PX) / RINGS
    radius = (np.arange(RINGS) + 0.5) * step[:, None]
    x = seeds[:, 0, None, None] + np.cos(turns)[:, None] * radius[:, None]
    y = seeds[:, 1, None, None] + np.sin(turns)[:, None] * radius[:, None]
    inside = (x >= 0) & (y >= 0) & (x <= cols - 1) & (y <= rows - 1)
    place = np.clip(np.rint(y), 0, rows - 1).astype(np.intp) * cols
    place += np.clip(np.rint(x), 0, cols - 1).astype(np.intp)
    # cv2.remap rounds places to 1/32 px before OpenCV 5
    light = ndi.map_coordinates(lightness.light, (y, x), order=1, mode="nearest", output=np.float32)
    light = light / lightness.texture.ravel()[place[:, :, :1]]
    edge = np.zeros(x.shape)
    edge[..., 1:-1] = np.abs(light[..., 2:] - light[..., :-2]) / step[:, None, None]
    kinds = lightness.kinds.ravel()[place]
    return Polar(
        radius=radius,
        step=step,
        area=(radius * step[:, None] * 2 * np.pi / RAYS)[:, None],
        edge=edge,
        unlike=kinds != GROUND,
        cast=kinds == CAST,
        shaded=kinds == SHADED,
        inside=inside,
        facet=seeds[:, 3] > 0,
    )
