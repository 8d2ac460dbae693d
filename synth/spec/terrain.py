"""Parameters of rough ground: relief at all scales, what covers it, its colours and its horizon."""

from typing import Annotated, Literal

from msgspec import Meta, Struct

from synth.spec.limits import Degrees, Fraction, Positive, Ratio, check_range

Colour = tuple[Ratio, Ratio, Ratio]
Height = Annotated[float, Meta(ge=0, le=2)]
Widths = Annotated[float, Meta(ge=0, le=10)]


class TerrainSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Rough ground. Reflectances are linear: red, green and blue."""

    relief_rms_m: Height = 0.0  # RMS height of the waves up to relief_length_m
    relief_length_m: Annotated[float, Meta(ge=0.5, le=20)] = 4.0  # longest of those waves
    relief_slope: Annotated[float, Meta(ge=2.1, le=4.5)] = 3.2  # power falls as frequency^−slope
    crust: Fraction = 0.0  # share of the ground under a cracked crust
    crust_plate_m: Annotated[float, Meta(ge=0.05, le=2)] = 0.25  # between cracks
    crust_depth_m: Height = 0.02  # of the cracks
    outcrop: Fraction = 0.0  # share of the ground where layered bedrock comes out
    outcrop_layer_m: Height = 0.06  # thickness of a layer
    outcrop_block_m: Annotated[float, Meta(ge=0.1, le=4)] = 0.5  # between joints
    drift: Fraction = 0.0  # share of the ground under drifts of dust or sand
    drift_height_m: Height = 0.06  # RMS height of the drifts' own swell
    drift_ripple_m: Annotated[float, Meta(ge=0, le=0.05)] = (
        0.003  # ripples on them, trough to crest
    )
    tail_length: tuple[Widths, Widths] = (0.0, 0.0)  # of the drifts behind rocks, in rock widths
    wind_deg: Degrees = 0.0  # where the wind that drifts them blows to, from x towards y
    grit_m: Annotated[float, Meta(ge=0, le=0.05)] = (
        0.0  # largest grit, in the light and not in the depth
    )
    hills_m: Annotated[float, Meta(ge=0, le=500)] = 0.0  # RMS height of the relief at the horizon
    haze_m: Annotated[float, Meta(gt=0, le=1e6)] | None = None  # distance that veils 63 %
    elevation: str = ""  # file of heights: GeoTIFF or TIFF, .npy, 16-bit PNG
    elevation_cell_m: Positive | None = None  # of the file; None: as a GeoTIFF says
    elevation_step_m: Annotated[float, Meta(gt=0, le=100)] = 1.0  # metres in a unit of the file
    elevation_gaps: Literal["refuse", "fill"] = "refuse"  # missing heights; fill: the nearest
    soil: Colour = (0.55, 0.55, 0.55)
    dust: Colour = (0.55, 0.55, 0.55)  # of drifts, and on the tops of pebbles
    bedrock: Colour = (0.5, 0.5, 0.5)
    pebble: Colour = (0.5, 0.5, 0.5)

    def __post_init__(self) -> None:
        """Require a range in rising order."""
        check_range("tail_length", self.tail_length)
