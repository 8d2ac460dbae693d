"""The knobs of the rocks."""

from typing import Annotated, Literal

from msgspec import Meta, Struct

from synth.spec.limits import Count, Fraction, PositiveRange, RatioRange, check_range

Family = Literal["rounded-polyhedron", "ellipsoid", "rounded-box", "perturbed", "mixed"]
Series = Literal["graded", "random"]

Cuts = Annotated[int, Meta(ge=6, le=80)]
Rounding = Annotated[float, Meta(ge=0.005, le=5)]
Degree = Annotated[int, Meta(ge=1, le=60)]


class RocksSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """What lies on the ground. A pair is a range [low, high] that each rock's value is drawn from.

    `graded` gives all rocks of a scene the same half-axes and the same polyhedron, and spreads the
    rounding over its range; `random` draws everything for each rock.
    """

    count: Count = 6
    family: Family = "rounded-polyhedron"
    series: Series = "graded"
    diameter_m: PositiveRange = (0.28, 0.42)  # 2a, the longest side of the smallest box
    b_over_a: RatioRange = (0.72, 0.92)
    c_over_b: RatioRange = (0.65, 0.88)
    cuts: tuple[Cuts, Cuts] = (11, 15)
    rounding: tuple[Rounding, Rounding] = (0.02, 0.8)  # r over the inradius before rounding
    relief_rms: tuple[Fraction, Fraction] = (0.015, 0.045)  # over the cube root of abc
    relief_degrees: tuple[Degree, Degree] = (3, 14)  # spherical harmonics, both ends included
    albedo: RatioRange = (0.42, 0.62)
    spacing: Annotated[float, Meta(ge=1, le=10)] = 1.35  # least distance over the sum of radii

    def __post_init__(self) -> None:
        """Hold the ranges in order and the series to the families that have a rounding."""
        check_range("diameter_m", self.diameter_m)
        check_range("b_over_a", self.b_over_a)
        check_range("c_over_b", self.c_over_b)
        check_range("cuts", self.cuts)
        check_range("rounding", self.rounding)
        check_range("relief_rms", self.relief_rms)
        check_range("relief_degrees", self.relief_degrees)
        check_range("albedo", self.albedo)
        if self.series == "graded" and self.family not in ("rounded-polyhedron", "rounded-box"):
            raise ValueError(
                "series: 'graded' needs the family rounded-polyhedron or rounded-box, "
                f'found {self.family!r} (set series = "random")'
            )
