"""Mixture of made pictures that the network is taught with, and that it is judged on.

Shards of tiles are functions of their number alone, so any of them can be made again.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from synth.bed.make import make_tile
from synth.spec.bed import BedSpec, convert_bed_spec
from training.sites import site_tiles
from training.tile import SIDE_PX, Tile

_SHARD_TILES = 64
JUDGED = 10_000  # seeds of tiles to be judged on begin here
_SMOOTH = {"kinds": ["dust"], "relief": [0.0, 0.1], "filled": 0.0}
_AFRESH = 8  # tiles of a bed's set, whose bodies are drawn once


@dataclass(frozen=True)
class Part:
    """Kind of picture: its name, its share of the tiles, and how a shard of it is made."""

    name: str
    share: float
    make: Callable[[int, int, bool], list[Tile]]  # of a seed, so many, on smooth ground or rough


@dataclass(frozen=True)
class _Beds:
    """Shards of gravel beds: keys of their specification."""

    keys: Mapping[str, Any] = field(default_factory=dict)

    def __call__(self, seed: int, tiles: int, smooth: bool) -> list[Tile]:
        made: list[Tile] = []
        for number in range(tiles):
            spec = self._spec(seed * 100 + number // _AFRESH, smooth)
            bed = make_tile(spec, number % _AFRESH)
            made.append(Tile(bed.image, bed.labels))
        return made

    def _spec(self, seed: int, smooth: bool) -> BedSpec:
        size = {"width_px": SIDE_PX, "height_px": SIDE_PX}
        ground = {"ground": _SMOOTH} if smooth else {}
        return convert_bed_spec({**size, **self.keys, **ground, "seed": seed}, where="mixture")


PARTS: Sequence[Part] = (
    Part("beds", 0.24, _Beds()),
    Part("packed", 0.1, _Beds({"grains": {"cover": [1.6, 3.0], "median_px": [9, 24]}})),
    Part("oblique", 0.12, _Beds({"tilt_deg": [15, 65]})),
    Part("cobbles", 0.08, _Beds({"grains": {"median_px": [40, 110], "spread": [0.3, 0.9]}})),
    Part(
        "sunk",
        0.12,
        _Beds(
            {
                "tilt_deg": [0, 30],
                "grains": {"median_px": [12, 40], "spread": [0.5, 1.0], "burial": [0.1, 0.8]},
                "ground": {"filled": 1.0, "fill": [0.2, 0.7]},
            }
        ),
    ),
    Part(
        "scattered",
        0.18,
        _Beds(
            {
                "tilt_deg": [0, 65],
                "grains": {
                    "cover": [0.03, 0.4],
                    "median_px": [9, 60],
                    "spread": [0.4, 1.1],
                    "burial": [0.0, 0.8],
                },
                "ground": {"filled": 0.0},
            }
        ),
    ),
    Part("bare", 0.04, _Beds({"tilt_deg": [0, 65], "grains": {"count": 0}})),
    Part("sites", 0.12, site_tiles),
)
NAMES = tuple(part.name for part in PARTS)


@dataclass(frozen=True)
class Shard:
    """Tiles that are made together and lie in one file."""

    part: str
    seed: int
    tiles: int
    smooth: bool = False  # ground, for an ablation

    def make(self) -> list[Tile]:
        """Tiles, the same each time."""
        return {part.name: part for part in PARTS}[self.part].make(
            self.seed, self.tiles, self.smooth
        )

    @property
    def file(self) -> str:
        """Name of the shard's file."""
        ground = "-smooth" if self.smooth else ""
        return f"{self.part}-{self.seed:06d}-{self.tiles}{ground}.npz"


def shards(tiles: int, *, only: Collection[str] = NAMES, smooth: bool = False) -> list[Shard]:
    """Shards that make up about so many tiles, of some parts, at least one tile of each.

    They are spread so that any first stretch of them has all parts in about their shares.
    """
    parts = [part for part in PARTS if part.name in only]
    total = sum(part.share for part in parts)
    places = []
    for part in parts:
        own = max(1, round(part.share / total * tiles))
        count = -(-own // _SHARD_TILES)
        for number in range(count):
            shard = Shard(part.name, number, min(_SHARD_TILES, own), smooth)
            places.append(((number + 0.5) / count, shard))
    places.sort(key=lambda place: place[0])
    return [shard for _, shard in places]
