"""Parameters of the rocks: family, series, size, form and surface."""

from typing import Annotated, Any, Literal, Protocol

import msgspec
from msgspec import UNSET, Meta, Struct, UnsetType

from synth.errors import SpecError
from synth.spec.limits import (
    MAX_COUNT,
    AxisRatioRange,
    Fraction,
    PositiveRange,
    RatioRange,
    check_range,
)
from synth.spec.registry import Record, Registry, options_of

Series = Literal["auto", "graded", "sphericity", "relief", "random"]

Cuts = Annotated[int, Meta(ge=6, le=80)]
Chips = Annotated[int, Meta(ge=0, le=200)]
Rounding = Annotated[float, Meta(ge=0.005, le=5)]
Exponent = Annotated[float, Meta(ge=2, le=10)]
Softness = Annotated[float, Meta(ge=0.01, le=0.5)]
Subdivisions = Annotated[int, Meta(ge=4, le=7)]
Degree = Annotated[int, Meta(ge=1, le=60)]
Files = Annotated[tuple[str, ...], Meta(max_length=1000)]

_GRADED = ("graded", "sphericity")  # series that hold or turn the rounding
_DEFAULTS = ("rounded-polyhedron", "auto")  # a family that can be graded, and the series


class FamilyRecord(Record, Protocol):
    """What a spec has to know of a rock family."""

    @property
    def series(self) -> tuple[str, ...]:
        """The series that it can be graded in."""

    def check(self, spec: "RocksSpec") -> None:
        """Raise ValueError, its text beginning with the key, where the family lacks something."""


FAMILIES: Registry[FamilyRecord] = Registry(
    "rock family",
    group="synth.families",
    own={
        "rounded-polyhedron": "synth.rocks.families.rounded_polyhedron:ROUNDED_POLYHEDRON",
        "ellipsoid": "synth.rocks.families.ellipsoid:ELLIPSOID",
        "rounded-box": "synth.rocks.families.rounded_box:ROUNDED_BOX",
        "perturbed": "synth.rocks.families.perturbed:PERTURBED",
        "superellipsoid": "synth.rocks.families.superellipsoid:SUPERELLIPSOID",
        "realistic": "synth.rocks.families.realistic:REALISTIC",
        "dented": "synth.rocks.families.dented:DENTED",
        "lumpy": "synth.rocks.families.lumpy:LUMPY",
        "broken": "synth.rocks.families.broken:BROKEN",
        "vesicular": "synth.rocks.families.vesicular:VESICULAR",
        "slab": "synth.rocks.families.slab:SLAB",
        "scan": "synth.rocks.families.scan:SCAN",
        "mixed": "synth.rocks.families.mixed:MIXED",
        "field": "synth.rocks.families.field:FIELD",
    },
)


class RealismSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Fracture and wear of the rocks of the family `realistic`."""

    cuts: tuple[Cuts, Cuts] = (9, 16)  # main faces
    chips: tuple[Chips, Chips] = (10, 40)  # small cuts that take off corners and edges
    slab: tuple[Fraction, Fraction] = (0.0, 1.0)  # 0 a block … 1 two parallel sides
    abrasion: tuple[Fraction, Fraction] = (0.05, 0.6)  # 0 fresh … 1 worn
    waviness: tuple[Fraction, Fraction] = (0.02, 0.05)  # RMS of a face's undulation over its size
    relief_rms: tuple[Fraction, Fraction] = (0.003, 0.008)  # over the cube root of abc
    relief_degrees: tuple[Degree, Degree] = (15, 45)  # spherical harmonics, both ends included
    subdivisions: Subdivisions = 6  # 20 × 4^n facets

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        for name in (
            "cuts",
            "chips",
            "slab",
            "abrasion",
            "waviness",
            "relief_rms",
            "relief_degrees",
        ):
            check_range(f"realism.{name}", getattr(self, name))


class RocksSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Rocks of a scene. A pair is a range [low, high] from which each rock's value is drawn.

    `random` draws everything for each rock. The other series draw one form for a scene and spread
    one parameter over its range: `graded` the rounding at fixed half-axes; `sphericity` b/a and
    c/b at a fixed rounding; `relief` the relief's RMS on one form. `options` are a registered
    family's own.
    """

    count: Annotated[int, Meta(ge=0, le=MAX_COUNT)] = 6  # 0: a frame without any
    family: str = _DEFAULTS[0]
    series: Series = "auto"  # auto: graded where the family can be, else random
    diameter_m: PositiveRange = (0.28, 0.42)  # 2a, the longest side of the smallest box
    b_over_a: AxisRatioRange = (0.72, 0.92)
    c_over_b: AxisRatioRange = (0.65, 0.88)
    cuts: tuple[Cuts, Cuts] = (11, 15)
    rounding: tuple[Rounding, Rounding] = (0.02, 0.8)  # r over the inradius before rounding
    exponents: tuple[Exponent, Exponent] = (2.0, 6.0)  # of a superellipsoid; 2 is an ellipsoid
    scans: Files = ()  # PLY, OBJ or STL files, from the folder of the command
    relief: bool = False  # lay relief on the rocks of any family; `perturbed` always has it
    relief_rms: tuple[Fraction, Fraction] = (0.015, 0.045)  # over the cube root of abc
    relief_degrees: tuple[Degree, Degree] = (3, 14)  # spherical harmonics, both ends included
    realism: RealismSpec = RealismSpec()
    albedo: RatioRange = (0.42, 0.62)
    spacing: Annotated[float, Meta(ge=1, le=10)] = 1.35  # least distance over the sum of radii
    options: dict[str, Any] | UnsetType = UNSET  # not written to manifests unless it is given
    abrasion: tuple[Fraction, Fraction] | UnsetType = UNSET  # wear rocks of any family; likewise

    def __post_init__(self) -> None:
        """Require ranges in rising order, and a known family that the series and options suit."""
        for name in (
            "diameter_m",
            "b_over_a",
            "c_over_b",
            "cuts",
            "rounding",
            "exponents",
            "relief_rms",
            "relief_degrees",
            "albedo",
        ):
            check_range(name, getattr(self, name))
        if not isinstance(self.abrasion, UnsetType):
            check_range("abrasion", self.abrasion)
        plain = (self.family, self.series) == _DEFAULTS and self.options is UNSET
        series = "graded" if plain else self._checked_series()
        msgspec.structs.force_setattr(self, "series", series)
        if series in _GRADED and not isinstance(self.abrasion, UnsetType):
            raise ValueError(
                f"abrasion: expected none for the series {series!r}, whose rounding is exact, "
                f"found {list(self.abrasion)}"
            )

    def _checked_series(self) -> Series:
        """The series, `auto` resolved: `graded` where the family can be, else `random`."""
        try:
            family = FAMILIES.find(self.family)
        except SpecError as error:
            raise ValueError(f"family: {error}") from error
        series = self.series
        if series == "auto":
            series = "graded" if "graded" in family.series else "random"
        if series not in family.series:
            raise ValueError(
                f"series: expected one of {', '.join(family.series)} for the family "
                f"{self.family!r}, found {series!r}"
            )
        family.check(self)
        options_of("family", family, self.options)
        return series
