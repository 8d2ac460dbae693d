"""Making of one tile: ground, grains, light and photograph, a function of spec and index alone."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Singles
from synth.bed.bed import Bed
from synth.bed.packed import MARGIN_PX, pack_bed
from synth.bed.picture.albedo import (
    RockLook,
    draw_colours,
    draw_looks,
    reflectance,
)
from synth.bed.picture.light import draw_light
from synth.bed.picture.photograph import draw_photograph, photograph
from synth.bed.picture.texture import PATTERN, RELIEF, texture_maps, textures
from synth.bed.relief.packing import Footprint, Grain
from synth.bed.table import grain_table
from synth.spec.bed import BedSpec

_STREAMS = ("ground", "grains", "packing", "looks", "light", "photograph", "view")


def make_tile(spec: BedSpec, index: int) -> Bed:
    """Tile `index` of a set, the same to the byte in any process and with any number of threads.

    Each part draws from a generator of its own, so that a key changes no other part.
    """
    rng = {
        name: np.random.default_rng([spec.seed, 20 + number, index])
        for number, name in enumerate(_STREAMS)
    }
    per_px = spec.supersample
    bed = pack_bed(spec, rng)
    view = bed.view
    palette = spec.light.palettes[int(rng["looks"].integers(len(spec.light.palettes)))]
    colours = draw_colours(palette, rng["looks"])
    looks = _looks(bed.grains, bed.places, colours, rng["looks"])
    maps = texture_maps(spec.seed)
    pattern = list(maps)[int(rng["looks"].integers(len(maps)))]
    texture = textures(view.grain, looks.frame, maps[pattern], per_px=per_px, margin_px=MARGIN_PX)
    light = draw_light(spec.light, rng["light"])
    dust = float(rng["light"].uniform(*spec.light.dust)) * (rng["light"].uniform() < 0.5)
    relief = _relief(view.grain, looks, texture)
    lit = view.shine(relief, light, albedo=float(colours[1].mean()))
    albedo = reflectance(view.grain, looks, texture, view.tint, lit.up, dust=dust)
    photo = draw_photograph(spec.photo, rng["photograph"])
    picture = photograph(_pixel_means(albedo * lit.arriving, per_px), photo, rng["photograph"])
    labels, seen, counts = _renumbered(_centres(view.grain, per_px))
    return Bed(
        image=picture,
        labels=labels,
        height_px=_centres(lit.height_px, per_px),
        normals=_centres(lit.normals, per_px),
        sunlit=_centres(lit.sunlit, per_px),
        albedo=_centres(albedo, per_px),
        rocks=grain_table(
            [bed.grains[one] for one in seen],
            [view.outline(one) for one in seen],
            counts,
            shape=labels.shape,
        ),
        conditions={
            "ground": bed.ground,
            "filled": bed.filled,
            "tilt_deg": bed.tilt_deg,
            "palette": palette,
            "pattern": pattern,
            "dust": dust,
            "overcast": light.overcast,
            "sky": light.sky,
            "sun_azimuth_deg": float(np.rad2deg(light.azimuth_rad)),
            "sun_elevation_deg": float(np.rad2deg(light.elevation_rad)),
            "grains_dropped": len(bed.grains),
            **asdict(photo),
        },
        seed=spec.seed,
        index=index,
        _masks=tuple(_tile_mask(*view.mask(one), per_px, labels.shape) for one in seen),
    )


def _looks(
    grains: Sequence[Grain],
    places: Sequence[Footprint],
    colours: tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]],
    rng: np.random.Generator,
) -> RockLook:
    return draw_looks(
        np.array([grain.width_px for grain in grains], dtype=np.float64),
        np.array([place.centre_px for place in places]).reshape(-1, 2),
        np.array([grain.body.roughness for grain in grains], dtype=np.float64),
        colours,
        rng,
    )


def _relief(grain: NDArray[np.int32], looks: RockLook, texture: Singles) -> tuple[Singles, Singles]:
    """Fine relief of the rocks' textures, px: grain, and pattern."""
    fine, pattern = (
        np.ascontiguousarray(looks.relief_px[:, column])[grain] * texture[..., channel]
        for column, channel in enumerate((RELIEF, PATTERN))
    )
    return fine, pattern


def _centres(samples: NDArray[Any], per_px: int) -> NDArray[Any]:
    """Values at the pixels' centres, without the margin."""
    edge = per_px * MARGIN_PX
    return np.ascontiguousarray(samples[edge:-edge:per_px, edge:-edge:per_px])


def _pixel_means(light: Singles, per_px: int) -> Singles:
    """Means over the pixels, by a tent as wide as two of them."""
    if per_px > 1:
        rise = np.arange(1, per_px + 1)
        tent = np.concatenate([rise, rise[-2::-1]]).astype(np.float32) / np.float32(per_px**2)
        light = np.asarray(cv2.sepFilter2D(light, cv2.CV_32F, tent, tent), dtype=np.float32)
    return _centres(light, per_px)


def _renumbered(
    grain: NDArray[np.int32],
) -> tuple[NDArray[np.uint16], NDArray[np.int64], NDArray[np.int64]]:
    """Labels from 1 on, the indices of the grains in sight, and their pixels."""
    counts = np.bincount(grain.ravel())
    counts[0] = 0
    seen = np.flatnonzero(counts)
    table = np.zeros(len(counts), dtype=np.uint16)
    table[seen] = np.arange(1, len(seen) + 1)
    return table[grain], seen - 1, counts[seen]


def _tile_mask(
    first: tuple[int, int], mask: NDArray[np.bool_], per_px: int, shape: tuple[int, int]
) -> tuple[int, int, NDArray[np.bool_]]:
    """Whole mask of a grain at the pixels' centres, with its first row and column in the tile."""
    row, column = first
    skip_rows, skip_columns = -row % per_px, -column % per_px
    mask = mask[skip_rows::per_px, skip_columns::per_px]
    top = (row + skip_rows) // per_px - MARGIN_PX
    left = (column + skip_columns) // per_px - MARGIN_PX
    mask = mask[max(-top, 0) : max(shape[0] - top, 0), max(-left, 0) : max(shape[1] - left, 0)]
    return max(top, 0), max(left, 0), mask.copy()
