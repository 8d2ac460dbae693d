"""Making of one tile: ground, grains, light and photograph, a function of spec and index alone."""

from dataclasses import asdict
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Singles
from synth.bed.bed import Bed
from synth.bed.picture.albedo import (
    RockLook,
    draw_colours,
    draw_looks,
    reflectance,
)
from synth.bed.picture.light import draw_light, shine
from synth.bed.picture.photograph import draw_photograph, photograph
from synth.bed.picture.texture import PATTERN, RELIEF, texture_maps, textures
from synth.bed.relief.bodies import body_library
from synth.bed.relief.ground import fill, ground_maps, make_ground
from synth.bed.relief.packing import Footprint, Grain, HeightField, pack
from synth.bed.relief.sizes import draw_grains
from synth.bed.table import grain_table
from synth.spec.bed import BedSpec

_MARGIN_PX = 16  # of bed round the tile, so that its edge is lit and covered like its middle
_STREAMS = ("ground", "grains", "packing", "looks", "light", "photograph")


def make_tile(spec: BedSpec, index: int) -> Bed:
    """Tile `index` of a set, the same to the byte in any process and with any number of threads.

    Each part draws from a generator of its own, so that a key changes no other part.
    """
    rng = {
        name: np.random.default_rng([spec.seed, 20 + number, index])
        for number, name in enumerate(_STREAMS)
    }
    per_px = spec.supersample
    shape = (per_px * (spec.height_px + 2 * _MARGIN_PX), per_px * (spec.width_px + 2 * _MARGIN_PX))
    kind = spec.ground.kinds[int(rng["ground"].integers(len(spec.ground.kinds)))]
    height, tint = make_ground(
        kind,
        shape,
        samples_per_px=per_px,
        relief=float(rng["ground"].uniform(*spec.ground.relief)),
        maps=ground_maps(spec.seed),
        rng=rng["ground"],
    )
    level = float(rng["ground"].uniform(*spec.ground.fill))
    filled = bool(rng["ground"].uniform() < spec.ground.filled)
    library = body_library(spec.seed, spec.bodies)
    area_px2 = shape[0] * shape[1] / per_px**2
    grains = draw_grains(spec.grains, library, area_px2, rng["grains"])
    field = HeightField(height.copy(), np.zeros(shape, np.int32), per_px, _MARGIN_PX)
    places = pack(field, grains, rng["packing"])
    if filled and grains:
        fill(field.height_px, field.grain, height, level)
    palette = spec.light.palettes[int(rng["looks"].integers(len(spec.light.palettes)))]
    colours = draw_colours(palette, rng["looks"])
    looks = _looks(grains, places, colours, rng["looks"])
    maps = texture_maps(spec.seed)
    pattern = list(maps)[int(rng["looks"].integers(len(maps)))]
    texture = textures(field.grain, looks.frame, maps[pattern], per_px=per_px, margin_px=_MARGIN_PX)
    _roughen(field, looks, texture)
    light = draw_light(spec.light, rng["light"])
    dust = float(rng["light"].uniform(*spec.light.dust)) * (rng["light"].uniform() < 0.5)
    lit = shine(field.height_px, per_px, light, albedo=float(colours[1].mean()))
    albedo = reflectance(
        field.grain, looks, texture, tint, np.ascontiguousarray(lit.normals[..., 2]), dust=dust
    )
    photo = draw_photograph(spec.photo, rng["photograph"])
    picture = photograph(_pixel_means(albedo * lit.arriving, per_px), photo, rng["photograph"])
    labels, seen, counts = _renumbered(_centres(field.grain, per_px))
    return Bed(
        image=picture,
        labels=labels,
        height_px=_centres(field.height_px, per_px),
        normals=_centres(lit.normals, per_px),
        sunlit=_centres(lit.sunlit, per_px),
        albedo=_centres(albedo, per_px),
        rocks=grain_table(grains, places, seen, counts, shape=labels.shape),
        conditions={
            "ground": kind,
            "filled": filled,
            "palette": palette,
            "pattern": pattern,
            "dust": dust,
            "overcast": light.overcast,
            "sky": light.sky,
            "sun_azimuth_deg": float(np.rad2deg(light.azimuth_rad)),
            "sun_elevation_deg": float(np.rad2deg(light.elevation_rad)),
            "grains_dropped": len(grains),
            **asdict(photo),
        },
        seed=spec.seed,
        index=index,
        _masks=tuple(_tile_mask(places[one], per_px, labels.shape) for one in seen),
    )


def _looks(
    grains: list[Grain],
    places: tuple[Footprint, ...],
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


def _roughen(field: HeightField, looks: RockLook, texture: Singles) -> None:
    """Add the relief of the rocks' textures to the heights."""
    for column, channel in enumerate((RELIEF, PATTERN)):
        amplitude = np.ascontiguousarray(looks.relief_px[:, column])[field.grain]
        field.height_px += amplitude * texture[..., channel]


def _centres(samples: NDArray[Any], per_px: int) -> NDArray[Any]:
    """Values at the pixels' centres, without the margin."""
    edge = per_px * _MARGIN_PX
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
    place: Footprint, per_px: int, shape: tuple[int, int]
) -> tuple[int, int, NDArray[np.bool_]]:
    """Whole mask of a grain at the pixels' centres, with its first row and column in the tile."""
    row, column = place.first
    skip_rows, skip_columns = -row % per_px, -column % per_px
    mask = place.mask[skip_rows::per_px, skip_columns::per_px]
    top = (row + skip_rows) // per_px - _MARGIN_PX
    left = (column + skip_columns) // per_px - _MARGIN_PX
    mask = mask[max(-top, 0) : max(shape[0] - top, 0), max(-left, 0) : max(shape[1] - left, 0)]
    return max(top, 0), max(left, 0), mask.copy()
