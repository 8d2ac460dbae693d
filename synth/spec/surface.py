"""Parameters of surfaces: albedo, dust and photometry."""

from typing import Annotated, Literal

from msgspec import UNSET, Meta, Struct, UnsetType

from synth.spec.limits import Fraction, Ratio


class SurfaceSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Surfaces: albedo, dust and the photometric law of ground and rocks; see docs/scenes.md."""

    law: Literal["lambert", "lommel-seeliger", "lunar-lambert"] = "lambert"
    lunar_share: Fraction = 0.6  # of Lommel–Seeliger in lunar-lambert
    contrast: Annotated[float, Meta(ge=0, le=0.5)] = 0.11  # RMS of the texture over the albedo
    ground_albedo: Ratio = 0.55
    dust: Fraction = 0.0  # share of a level top that dust of the ground's albedo covers
    # not written to manifests unless it is given:
    grain: Fraction | UnsetType = UNSET  # RMS slope of rocks' relief finer than their triangles


def grain_of(surface: SurfaceSpec) -> float:
    """RMS slope of the rocks' fine relief: the spec's, or none."""
    return 0.0 if isinstance(surface.grain, UnsetType) else surface.grain
