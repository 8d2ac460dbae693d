"""Parameters of colour: rock types, ground and dust."""

from typing import Annotated, Literal

from msgspec import Meta, Struct

from synth.spec.limits import Fraction, PositiveRange, Ratio, check_range

LithologyName = Literal["grey", "basalt", "weathered", "dusty", "red", "tan", "pale"]
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
    veins: Fraction = 0.0  # share of the rocks that have pale veins
    vein_width_m: PositiveRange = (0.002, 0.012)
    layers: Fraction = 0.0  # share of the rocks that are layered
    layer_m: PositiveRange = (0.01, 0.06)  # thickness of a light and a dark layer together
    wetness: tuple[Fraction, Fraction] = (0.0, 0.0)  # of a scene: 0 dry … 1 under a film of water

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        for name in ("vein_width_m", "layer_m", "wetness"):
            check_range(name, getattr(self, name))
