"""Parameters of the ground and of how rocks lie on it."""

from typing import Annotated, Literal

from msgspec import UNSET, Meta, Struct, UnsetType

from synth.spec.limits import Degrees, Fraction, Positive, PositiveRange, check_range
from synth.spec.terrain import TerrainSpec


class GroundSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Ground: slope, ripples, pebbles, burial. By default a level plane with rocks on top."""

    slope_deg: Annotated[float, Meta(ge=0, le=30)] = 0.0
    slope_azimuth_deg: Degrees = 0.0  # where it rises, from x towards y
    ripple_height_m: Annotated[float, Meta(ge=0, le=1)] = 0.0  # from trough to crest
    ripple_length_m: Positive = 0.4  # from crest to crest, more than 6 heights
    ripple_azimuth_deg: Degrees = 20.0  # across the crests
    pebbles_per_m2: Annotated[float, Meta(ge=0, le=2000)] = 0.0
    pebble_diameter_m: PositiveRange = (0.008, 0.03)
    burial: tuple[Fraction, Fraction] = (0.0, 0.0)  # share of a rock's height below the ground
    resting: Literal["flattest", "stable"] = "flattest"  # lowest centroid; or any stable side
    terrain: TerrainSpec | UnsetType = UNSET  # rough ground; not written to manifests unless given

    def __post_init__(self) -> None:
        """Require ranges in rising order, and ripples with slopes that sand can have."""
        check_range("pebble_diameter_m", self.pebble_diameter_m)
        check_range("burial", self.burial)
        if self.burial[1] > 0.9:
            raise ValueError(f"burial: expected at most 0.9, found {self.burial[1]:g}")
        if self.ripple_length_m < 6.0 * self.ripple_height_m:
            raise ValueError(
                f"ripple_height_m: expected at most a sixth of ripple_length_m, "
                f"found {self.ripple_height_m:g} of {self.ripple_length_m:g}"
            )
