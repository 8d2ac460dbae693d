"""Parameters of things that are no rocks."""

from typing import Annotated, Literal

from msgspec import Meta, Struct

ThingName = Literal["ruler", "cable", "wheel", "deck", "coin", "ball", "mast-shadow"]
Length = Annotated[float, Meta(ge=0.01, le=10)]


class ThingsSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Things among the rocks: one of each name, more where it is named more often."""

    kinds: Annotated[tuple[ThingName, ...], Meta(max_length=50)] = ("ruler",)
    ruler_m: Length = 0.3  # length of the ruler
    cable_m: Length = 2.0  # length of the cable
