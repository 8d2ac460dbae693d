"""Parameters of the view: camera, stations and sun."""

from typing import Annotated, Literal

from msgspec import Meta, Struct

from synth.spec.limits import Count, Degrees, Fraction, Positive

Length = Annotated[float, Meta(ge=-1000, le=1000)]
Coefficient = Annotated[float, Meta(ge=-1, le=1)]

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
    """Camera and the place of its mast."""

    preset: PresetName = "msl-navcam"
    distance_m: Positive | None = None  # camera to the scene's centre; None: the preset's own
    elevation_deg: Annotated[float, Meta(ge=5, le=90)] = 32.0  # of the camera, seen from the centre
    roll_deg: Degrees = 0.0  # about the axis, clockwise as the camera sees its own turn
    target_m: tuple[Length, Length, Length] = (0.0, 0.0, 0.0)  # what it looks at
    # k1, k2, p1, p2, k3 as in OpenCV; all zero is a pinhole
    distortion: tuple[Coefficient, Coefficient, Coefficient, Coefficient, Coefficient] = (
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    )
    supersample: Annotated[int, Meta(ge=1, le=4)] = 2  # of the image, never of depth or labels


class ViewsSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Camera stations, all looking at camera.target_m but on a pan.

    `ring`: evenly round the scene's centre. `arc`: evenly over a part of the ring, `start_deg` in
    its middle. `drive-by`: evenly along a straight line that passes the centre on one side, its
    middle at `start_deg`. `pan`: from one station at `start_deg`, the camera turned about its mast
    evenly over `arc_deg`, camera.target_m in the middle; for populations, since no rock could be in
    every view.
    """

    count: Count = 4
    path: Literal["ring", "arc", "drive-by", "pan"] = "ring"
    start_deg: Degrees = (
        0.0  # azimuth of the first (ring), middle or only station, from x towards y
    )
    arc_deg: Annotated[float, Meta(gt=0, le=360)] = (
        60.0  # from the first station (pan: direction) to the last
    )
    length_m: Positive = 3.0  # of the drive, from the first station to the last


class SunSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Light of one sun and a sky."""

    azimuth_deg: Degrees = 140.0  # towards the sun, from x towards y
    elevation_deg: Annotated[float, Meta(gt=0, le=90)] = 48.0
    ambient: Fraction = 0.3  # share of the sky in the light on level ground facing the sun
    shadows: bool = True
