"""The knobs of what is seen: camera, stations and sun."""

from typing import Annotated, Literal

from msgspec import Meta, Struct

from synth.spec.limits import Count, Degrees, Fraction, Positive

PresetName = Literal[
    "imp",
    "sojourner",
    "mer-navcam",
    "mer-hazcam",
    "mer-pancam",
    "msl-navcam",
    "m2020-navcam",
]


class CameraSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The camera and where its mast stands."""

    preset: PresetName = "msl-navcam"
    distance_m: Positive | None = None  # camera to the scene's centre; None: the preset's own
    elevation_deg: Annotated[float, Meta(ge=5, le=90)] = 32.0  # of the camera, seen from the centre
    supersample: Annotated[int, Meta(ge=1, le=4)] = 2  # of the image, never of depth or labels


class ViewsSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The camera's stations: a ring, evenly round the scene's centre, looking at it."""

    count: Count = 4
    path: Literal["ring"] = "ring"
    start_deg: Degrees = 0.0  # azimuth of the first station, from x towards y


class SunSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One sun and a sky."""

    azimuth_deg: Degrees = 140.0  # towards the sun, from x towards y
    elevation_deg: Annotated[float, Meta(gt=0, le=90)] = 48.0
    ambient: Fraction = 0.3  # share of the sky in the light on level ground facing the sun
    shadows: bool = True
