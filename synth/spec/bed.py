"""Parameters of gravel beds: grains, ground, light and photograph of each tile."""

from pathlib import Path
from typing import Annotated, Literal

from msgspec import Meta, Struct

from synth.spec.convert import convert_table
from synth.spec.limits import Fraction, check_range
from synth.spec.toml import read_toml

GrainShape = Literal["cobble", "angular", "slab", "broken", "lumpy"]
BedGround = Literal["sand", "rubble", "crust", "ripples", "dust"]
Palette = Literal["river", "limestone", "mars", "basalt", "mixed"]
MAX_TILES = 1_000_000
MAX_GRAINS = 20_000  # labels have 16 bits

Pixels = Annotated[float, Meta(ge=2, le=2000)]
Elevation = Annotated[float, Meta(ge=3, le=90)]
Azimuth = Annotated[float, Meta(ge=-360, le=360)]
Quality = Annotated[int, Meta(ge=1, le=100)]
Drawn = Annotated[float, Meta(ge=0.1, le=1)]  # thinner grains have gaps between samples
Brightness = Annotated[float, Meta(ge=0.02, le=0.95)]
Share = tuple[Fraction, Fraction]
Tilt = Annotated[float, Meta(ge=0, le=70)]


class GrainsSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Grains: sizes, number and forms. Widths are least calipers of whole outlines in plan.

    With `percentiles` the pairs are a share of the number of grains in percent and the width
    below which they lie; between them the logarithm of the width is linear.
    """

    distribution: Literal["lognormal", "percentiles"] = "lognormal"
    median_px: tuple[Pixels, Pixels] = (11.0, 40.0)  # of the tile, drawn evenly in its logarithm
    spread: tuple[Annotated[float, Meta(ge=0, le=2)], Annotated[float, Meta(ge=0, le=2)]] = (
        0.25,
        0.65,
    )  # standard deviation of ln width
    percentiles: tuple[tuple[Annotated[float, Meta(ge=0, le=100)], Pixels], ...] = (
        (0.0, 8.0),
        (16.0, 12.0),
        (50.0, 20.0),
        (84.0, 40.0),
        (100.0, 120.0),
    )
    width_px: tuple[Pixels, Pixels] = (8.0, 400.0)  # no grain is narrower or wider
    cover: tuple[Annotated[float, Meta(ge=0, le=6)], Annotated[float, Meta(ge=0, le=6)]] = (
        0.15,
        2.2,
    )  # area of all outlines over that of the ground; 2.5 leaves hardly any ground in sight
    count: Annotated[int, Meta(ge=0, le=MAX_GRAINS)] | None = None  # in place of `cover`
    axis_ratio: tuple[Drawn, Drawn] = (0.5, 1.0)  # how bodies are drawn out in plan
    flatness: tuple[Drawn, Drawn] = (0.4, 0.9)  # thickness over width
    shapes: Annotated[tuple[GrainShape, ...], Meta(min_length=1)] = (
        "cobble",
        "angular",
        "slab",
        "broken",
        "lumpy",
    )  # a tile has up to three of them
    burial: Share = (0.0, 0.6)  # share of a grain's thickness below the ground that it lies on

    def __post_init__(self) -> None:
        """Require ranges in rising order, and rising percentiles."""
        for name in ("median_px", "spread", "width_px", "cover", "axis_ratio", "flatness"):
            check_range(name, getattr(self, name))
        check_range("burial", self.burial)
        steps = zip(self.percentiles, self.percentiles[1:], strict=False)
        rising = all(one[0] < two[0] and one[1] <= two[1] for one, two in steps)
        if len(self.percentiles) < 2 or not rising:
            raise ValueError(
                "percentiles: expected two or more pairs [percent, px] in rising order, "
                f"found {[list(pair) for pair in self.percentiles]}"
            )


class BedGroundSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Ground under and between the grains; each tile has one kind."""

    kinds: Annotated[tuple[BedGround, ...], Meta(min_length=1)] = (
        "sand",
        "rubble",
        "crust",
        "ripples",
        "dust",
    )
    relief: tuple[Annotated[float, Meta(ge=0, le=10)], Annotated[float, Meta(ge=0, le=10)]] = (
        0.4,
        1.6,
    )  # times the usual height of its swells
    fill: Share = (0.0, 0.45)  # share of the bed's relief up to which sand fills it
    filled: Fraction = 0.35  # share of tiles with sand between the grains

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        check_range("relief", self.relief)
        check_range("fill", self.fill)


class BedLightSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Sun, sky and the colours of rocks and ground."""

    azimuth_deg: tuple[Azimuth, Azimuth] = (0.0, 360.0)  # towards the sun, from +x towards +y
    elevation_deg: tuple[Elevation, Elevation] = (14.0, 75.0)
    sky: Share = (0.08, 0.35)  # share of the sky in the light on level ground
    overcast: Fraction = 0.25  # share of tiles under a clouded sky, without a shadow to speak of
    palettes: Annotated[tuple[Palette, ...], Meta(min_length=1)] = (
        "river",
        "limestone",
        "mars",
        "basalt",
        "mixed",
    )
    dust: Share = (0.0, 0.5)  # share of level tops that dust of the ground's colour covers

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        for name in ("azimuth_deg", "elevation_deg", "sky", "dust"):
            check_range(name, getattr(self, name))


class BedPhotoSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Photograph: what lies between light and file."""

    brightness: tuple[Brightness, Brightness] = (0.38, 0.62)  # mean of the picture, 1 for white
    contrast: tuple[Annotated[float, Meta(gt=0, le=4)], Annotated[float, Meta(gt=0, le=4)]] = (
        0.9,
        1.6,
    )  # slope of the tone curve at the mean
    blur_px: tuple[Annotated[float, Meta(ge=0, le=20)], Annotated[float, Meta(ge=0, le=20)]] = (
        0.2,
        0.85,
    )  # standard deviation
    sharpening: tuple[Annotated[float, Meta(ge=0, le=4)], Annotated[float, Meta(ge=0, le=4)]] = (
        0.0,
        0.8,
    )  # share of what a blur takes away that is added again
    noise: tuple[Annotated[float, Meta(ge=0, le=1)], Annotated[float, Meta(ge=0, le=1)]] = (
        0.001,
        0.02,
    )  # RMS at the mean brightness, 1 for white
    jpeg_quality: tuple[Quality, Quality] | None = (55, 97)  # None: no loss
    grey: Fraction = 0.25  # share of tiles without colour

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        for name in ("brightness", "contrast", "blur_px", "sharpening", "noise"):
            check_range(name, getattr(self, name))
        if self.jpeg_quality is not None:
            check_range("jpeg_quality", self.jpeg_quality)


class BedSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Specification of a set of tiles. Tile i is a function of the spec and i alone.

    A pair of numbers is a range from which each tile draws; a list of names is drawn from.
    """

    seed: Annotated[int, Meta(ge=0, le=2**63 - 1)] = 0
    tiles: Annotated[int, Meta(ge=1, le=MAX_TILES)] = 1
    width_px: Annotated[int, Meta(ge=16, le=8192)] = 256
    height_px: Annotated[int, Meta(ge=16, le=8192)] = 256
    tilt_deg: tuple[Tilt, Tilt] = (0.0, 0.0)  # of the line of sight from the vertical
    supersample: Annotated[int, Meta(ge=1, le=4)] = 2  # heights and light in a pixel, along a side
    bodies: Annotated[int, Meta(ge=1, le=5000)] = 250  # forms that grains are drawn from
    grains: GrainsSpec = GrainsSpec()
    ground: BedGroundSpec = BedGroundSpec()
    light: BedLightSpec = BedLightSpec()
    photo: BedPhotoSpec = BedPhotoSpec()

    def __post_init__(self) -> None:
        """Require a range in rising order."""
        check_range("tilt_deg", self.tilt_deg)


def load_bed_spec(path: Path) -> BedSpec:
    """Specification read from a TOML file; keys that it leaves out keep their defaults.

    Raises:
        SpecError: the file is missing, is no TOML, or holds a key or value that is not allowed.
    """
    return convert_bed_spec(read_toml(path), where=str(path))


def convert_bed_spec(table: object, *, where: str) -> BedSpec:
    """Specification converted from plain tables and checked; `where` begins the complaint.

    Raises:
        SpecError: a key or value that is not allowed; the message names it.
    """
    return convert_table(table, BedSpec, where=where)
