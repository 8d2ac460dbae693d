"""Outlines proposed from the image: star-shaped, each the cheapest closed path round a seed."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.segmentation.lightness import DARK, Lightness
from rockshape.segmentation.path import closed_paths

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

RAYS, RINGS = 64, 48
REACH, EXTRA_PX = 1.8, 8.0  # a rock ends within so many radii of its seed, and so many pixels
FEWEST_PIXELS = 60
DEPTHS_PX = (3, 6, 10, 16, 24)  # seeds are also what lies so deep within their border
GROUND_INSIDE = 0.12  # price of a pixel inside that looks like ground,
CAST_INSIDE = 0.6  # that is a cast shadow,
OTHER_INSIDE = 0.1  # that is unlike the ground but not of the seed,
OUT_OF_FRAME = 0.3
SEED_OUTSIDE = 1.0  # and of a pixel of the seed left outside
EDGE_PX = 2.5  # an edge as strong as the texture is worth so many pixels of ground inside
STRONGEST = 3.0
BEND = 0.25
STRIP_PX = 4.0  # outside the outline, looked at for what was left out
AT_ONCE = 400  # seeds; OpenCV's sampling takes up to 32,767 rows
OVERLAP = 16


@dataclass(frozen=True, eq=False)
class Stars:
    """Outlines proposed, and what speaks for each."""

    x: Floats  # (n, 64), px
    y: Floats  # (n, 64), px
    features: Floats  # (n, 8)


@dataclass(frozen=True, eq=False)
class _Polar:
    """What lies along the rays from the seeds; (n, rays, rings) unless said."""

    radius: Floats  # (n, rings)
    step: Floats  # (n,), between rings
    area: Floats  # (n, 1, rings), of a cell
    edge: Floats
    unlike: Mask
    cast: Mask
    shaded: Mask
    inside: Mask  # the frame


def propose(lightness: Lightness, *, taken: Mask) -> Stars | None:
    """Outlines round all seeds: what is unlike the ground and no cast shadow, and its cores.

    In polar coordinates about a seed the path minimises, over its inside, the price of pixels that
    look like ground or cast shadow, over its outside the price of the seed's own, less the strength
    of the edges it follows. Seeds whose middle is taken (rows, cols) are left out; None without
    any other.
    """
    seeds = _seeds(lightness)
    middle = np.rint(seeds[:, :2]).astype(np.intp)
    seeds = seeds[~taken[middle[:, 1], middle[:, 0]]]
    if len(seeds) == 0:
        return None
    parts = [_trace(lightness, seeds[i : i + AT_ONCE]) for i in range(0, len(seeds), AT_ONCE)]
    return Stars(
        *(
            np.concatenate([getattr(part, name) for part in parts])
            for name in ("x", "y", "features")
        )
    )


def _seeds(lightness: Lightness) -> Floats:
    """Centre x, y and radius of each seed's convex hull, (n, 3)."""
    solid = cv2.morphologyEx(
        (lightness.unlike & ~lightness.cast).astype(np.uint8),
        cv2.MORPH_OPEN,
        cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (3, 3)),
    )
    closed = cv2.morphologyEx(
        solid, cv2.MORPH_CLOSE, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (11, 11))
    )
    depth = cv2.distanceTransform(solid, cv2.DIST_L2, 5)
    seeds: list[tuple[float, float, float]] = []
    for mask, eaten in ((solid, 0), (closed, 0), *((depth > px, px) for px in DEPTHS_PX)):
        fewest = 0.3 * FEWEST_PIXELS if eaten else FEWEST_PIXELS
        contours, _ = cv2.findContours(
            mask.astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE
        )
        for contour in contours:
            # Pick's theorem: the pixels within and on a border through their centres
            if cv2.contourArea(contour) + len(contour) / 2 + 1 < fewest:
                continue
            hull = cv2.convexHull(contour)
            moments = cv2.moments(hull)
            if moments["m00"] <= 4:
                continue
            x, y = moments["m10"] / moments["m00"], moments["m01"] / moments["m00"]
            radius = float(np.hypot(hull[:, 0, 0] - x, hull[:, 0, 1] - y).max())
            seeds.append((x, y, radius + eaten))
    return np.array(seeds).reshape(-1, 3)


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
    left_out = np.cumsum((SEED_OUTSIDE * own * polar.area)[..., ::-1], axis=2)[..., ::-1]
    arc = (polar.radius * 2 * np.pi / RAYS)[:, None]
    gain = EDGE_PX * GROUND_INSIDE * np.minimum(polar.edge, STRONGEST) * arc
    scale = (reach * 2 * np.pi / RAYS * GROUND_INSIDE)[:, None, None]
    cost = ((inner + left_out - gain) / scale).astype(np.float32)
    bend = (BEND * polar.step / GROUND_INSIDE).astype(np.float32)
    path = np.stack(closed_paths(list(cost), bend=bend, overlap=OVERLAP))
    ends = np.take_along_axis(polar.radius, path, axis=1)
    return Stars(
        x=seeds[:, :1] + np.cos(turns) * ends,
        y=seeds[:, 1:2] + np.sin(turns) * ends,
        features=_features(polar, path, ends),
    )


def _unroll(lightness: Lightness, seeds: Floats, turns: Floats) -> _Polar:
    rows, cols = lightness.light.shape
    step = (REACH * seeds[:, 2] + EXTRA_PX) / RINGS
    radius = (np.arange(RINGS) + 0.5) * step[:, None]
    x = seeds[:, 0, None, None] + np.cos(turns)[:, None] * radius[:, None]
    y = seeds[:, 1, None, None] + np.sin(turns)[:, None] * radius[:, None]
    inside = (x >= 0) & (y >= 0) & (x <= cols - 1) & (y <= rows - 1)
    place = np.clip(np.rint(y), 0, rows - 1).astype(np.intp) * cols
    place += np.clip(np.rint(x), 0, cols - 1).astype(np.intp)
    light = cv2.remap(
        lightness.light,
        x.reshape(-1, RINGS).astype(np.float32),
        y.reshape(-1, RINGS).astype(np.float32),
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    ).reshape(x.shape)
    light = light / lightness.texture.ravel()[place[:, :, :1]]
    edge = np.zeros(x.shape)
    edge[..., 1:-1] = np.abs(light[..., 2:] - light[..., :-2]) / step[:, None, None]
    unlike, cast = lightness.unlike.ravel()[place], lightness.cast.ravel()[place]
    return _Polar(
        radius=radius,
        step=step,
        area=(radius * step[:, None] * 2 * np.pi / RAYS)[:, None],
        edge=edge,
        unlike=unlike,
        cast=cast,
        shaded=unlike & ~cast & (lightness.ratio.ravel()[place] < DARK),
        inside=inside,
    )


def _features(polar: _Polar, path: NDArray[np.intp], ends: Floats) -> Floats:
    """What speaks for an outline, (n, 8).

    Mean and lower quartile of the edge's strength along it, up to 6; shares of cast shadow, of what
    is unlike the ground and of own shade inside; roughness; share of what is unlike the ground in
    the strip around it; logarithm of its area.
    """
    edge = np.minimum(np.take_along_axis(polar.edge, path[..., None], axis=2)[..., 0], 6)
    rings = np.arange(RINGS)
    inside = rings <= path[..., None]
    area = (polar.area * inside).sum(axis=(1, 2))

    def share(mask: Mask) -> Floats:
        return np.asarray((polar.area * (inside & mask)).sum(axis=(1, 2)) / area)

    strip = (rings > path[..., None] + 1) & (polar.radius[:, None] < ends[..., None] + STRIP_PX)
    left_out = (strip & polar.unlike & ~polar.cast).sum(axis=(1, 2))
    jumps = np.abs(np.diff(ends, axis=1, append=ends[:, :1])).mean(axis=1)
    return np.column_stack(
        [
            edge.mean(axis=1),
            np.quantile(edge, 0.25, axis=1),
            share(polar.cast),
            share(polar.unlike),
            share(polar.shaded),
            jumps / ends.mean(axis=1),
            left_out / np.maximum(strip.sum(axis=(1, 2)), 1),
            np.log(area),
        ]
    )
