"""Parameters of each scene's own light: ranges of sun and haze, and their colours."""

from typing import Annotated

from msgspec import Meta, Struct

from synth.spec.limits import Degrees, Fraction, check_range
from synth.spec.tints import Rgb

Elevation = Annotated[float, Meta(gt=0, le=90)]


class LightSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Light drawn for each scene from ranges; what is left out is that of [sun]."""

    azimuth_deg: tuple[Degrees, Degrees] | None = None
    elevation_deg: tuple[Elevation, Elevation] | None = None
    ambient: tuple[Fraction, Fraction] | None = None  # the share of diffuse light: 1 overcast
    sun: Rgb = (1.0, 1.0, 1.0)  # linear; the colour alone counts
    sky: Rgb = (1.0, 1.0, 1.0)  # likewise

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        for name in ("azimuth_deg", "elevation_deg", "ambient"):
            limits = getattr(self, name)
            if limits is not None:
                check_range(name, limits)
