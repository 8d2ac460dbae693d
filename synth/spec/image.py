"""Parameters of pictures: colour, maps beside them, and how a camera develops light."""

from typing import Annotated, Literal

from msgspec import Meta, Struct

from synth.spec.limits import check_range

ToneName = Literal["linear", "srgb", "gamma", "filmic"]
Blur = Annotated[float, Meta(ge=0, le=20)]
Stops = Annotated[float, Meta(ge=-8, le=8)]


class ImageSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Pictures of a scene. A pair is a range [low, high] from which each view's value is drawn."""

    colour: bool = False  # also a colour picture
    normals: bool = False  # also the surface's normal at every pixel
    tone: ToneName = "linear"
    gamma: Annotated[float, Meta(ge=1, le=4)] = 2.2  # of the tone curve `gamma`
    exposure_stops: tuple[Stops, Stops] = (0.0, 0.0)  # error of the exposure
    blur_px: tuple[Blur, Blur] = (0.0, 0.0)  # standard deviation of the lens's blur
    white_balance: Annotated[float, Meta(ge=0, le=1)] = 0.0  # RMS log of the gains of red and blue

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        for name in ("exposure_stops", "blur_px"):
            check_range(name, getattr(self, name))
