"""The knobs of the rocks."""

from typing import Annotated, Literal

from msgspec import Meta, Struct

from synth.spec.limits import (
    AxisRatioRange,
    Count,
    Fraction,
    PositiveRange,
    RatioRange,
    check_range,
)

Family = Literal[
    "rounded-polyhedron",
    "ellipsoid",
    "rounded-box",
    "perturbed",
    "superellipsoid",
    "realistic",
    "scan",
    "mixed",
]
Series = Literal["graded", "sphericity", "relief", "random"]

Cuts = Annotated[int, Meta(ge=6, le=80)]
Chips = Annotated[int, Meta(ge=0, le=200)]
Rounding = Annotated[float, Meta(ge=0.005, le=5)]
Exponent = Annotated[float, Meta(ge=2, le=10)]
Degree = Annotated[int, Meta(ge=1, le=60)]
Files = Annotated[tuple[str, ...], Meta(max_length=1000)]

_WITH_ROUNDING = ("rounded-polyhedron", "rounded-box")


class RealismSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """How the rocks of the family `realistic` are broken and worn."""

    cuts: tuple[Cuts, Cuts] = (9, 16)  # main faces
    chips: tuple[Chips, Chips] = (10, 40)  # small cuts that take off corners and edges
    slab: tuple[Fraction, Fraction] = (0.0, 1.0)  # 0 a block … 1 two parallel sides
    abrasion: tuple[Fraction, Fraction] = (0.05, 0.6)  # 0 fresh … 1 worn
    waviness: tuple[Fraction, Fraction] = (0.02, 0.05)  # RMS of a face's undulation over its size
    relief_rms: tuple[Fraction, Fraction] = (0.003, 0.008)  # over the cube root of abc
    relief_degrees: tuple[Degree, Degree] = (15, 45)  # spherical harmonics, both ends included
    subdivisions: Annotated[int, Meta(ge=4, le=7)] = 6  # 20 × 4^n facets

    def __post_init__(self) -> None:
        """Hold the ranges in order."""
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
    """What lies on the ground. A pair is a range [low, high] that each rock's value is drawn from.

    `random` draws everything for each rock. The other series draw one form for a scene and spread
    one knob over its range: `graded` the rounding at fixed half-axes; `sphericity` b/a and c/b at
    a fixed rounding; `relief` the relief's RMS on one form.
    """

    count: Count = 6
    family: Family = "rounded-polyhedron"
    series: Series = "graded"
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

    def __post_init__(self) -> None:
        """Hold the ranges in order and the series to the families that have their knob."""
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
        if self.series in ("graded", "sphericity") and self.family not in _WITH_ROUNDING:
            raise ValueError(
                f"series: {self.series!r} needs the family rounded-polyhedron or rounded-box, "
                f'found {self.family!r} (set series = "random")'
            )
        if self.series == "relief" and self.family == "mixed":
            raise ValueError("series: 'relief' needs one family, found 'mixed'")
        if self.family == "scan" and not self.scans:
            raise ValueError("scans: expected mesh files for the family scan, found none")
