"""Parameters of colour: rock types, ground and dust."""

from typing import Annotated, Literal

from msgspec import Meta, Struct

from synth.spec.limits import Ratio

LithologyName = Literal["grey", "basalt", "dusty", "red", "tan", "pale"]
Rgb = tuple[Ratio, Ratio, Ratio]  # linear, with the primaries of sRGB


class TintsSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Colours of a scene's surfaces; brightness is that of rocks.albedo and surface.ground_albedo.

    A rock is of one of the lithologies, each as likely as it is often named.
    """

    lithologies: Annotated[tuple[LithologyName, ...], Meta(min_length=1, max_length=100)] = (
        "basalt",
        "basalt",
        "dusty",
        "pale",
    )
    spread: Annotated[float, Meta(ge=0, le=0.5)] = 0.06  # RMS of the log of a rock's red over blue
    ground: Rgb = (0.34, 0.27, 0.19)  # the colour alone counts
    dust: Rgb = (0.37, 0.27, 0.17)  # likewise
