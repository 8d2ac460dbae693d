"""Parameters of the sensor: the range it measures and the picture it takes."""

from typing import Annotated, Any, Literal

from msgspec import UNSET, Meta, Struct, UnsetType

from synth.errors import SpecError
from synth.spec.limits import Fraction
from synth.spec.registry import Record, Registry, options_of

SENSORS: Registry[Record] = Registry(
    "sensor",
    group="synth.sensors",
    own={
        "none": "synth.sensor.exact:EXACT",
        "stereo": "synth.sensor.stereo:STEREO",
        "sgm": "synth.sensor.sgm:SGM",
        "mesh": "synth.sensor.stereo_mesh:MESH",
        "tof": "synth.sensor.tof:TOF",
        "lidar": "synth.sensor.lidar:LIDAR",
    },
)
GreyLevels = Annotated[float, Meta(ge=0, le=255)]  # of 255
OddWindow = Annotated[int, Meta(ge=3, le=31)]


class NoiseSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Range sensor: one of the package, by its name, or a registered one.

    The default of `disparity_px` is the error that Kim et al. (2005) measured on targets with a
    rover's cameras: matching, vertical misalignment and calibration together. docs/dataset.md has
    the values for images as they are rendered here. `options` are a sensor's own; what is
    `stereo`'s alone goes for `mesh` too, which is made of its points.
    """

    kind: str = "none"
    disparity_px: Annotated[float, Meta(ge=0, le=10)] = 0.32  # σ_d of a match, `stereo` alone
    locking_px: Annotated[float, Meta(ge=0, le=0.15)] = 0.0  # pull to whole disparities, `stereo`
    weak_texture: GreyLevels = 0.0  # contrast at which the variance of σ_d is doubled, `stereo`
    window_px: OddWindow = 7  # side of the matching window, odd
    step_px: Annotated[float, Meta(ge=0, le=1)] = 0.0625  # disparity's steps, `stereo`; 0: none
    min_texture: GreyLevels = 1.0  # least contrast, `stereo`
    # not written to manifests unless they are given:
    fattening: Fraction | UnsetType = UNSET  # edges move out so much of half a window, `stereo`
    options: dict[str, Any] | UnsetType = UNSET

    def __post_init__(self) -> None:
        """Require a known sensor with options that it has, and a window with a middle pixel."""
        if self.kind not in SENSORS.own or self.options is not UNSET:
            try:
                sensor = SENSORS.find(self.kind)
            except SpecError as error:
                raise ValueError(f"kind: {error}") from error
            options_of("sensor", sensor, self.options)
        if self.window_px % 2 == 0:
            raise ValueError(f"window_px: expected an odd number, found {self.window_px}")


def fattening_px(noise: NoiseSpec) -> int:
    """Pixels by which windows that bleed move depth edges out of the nearer surface."""
    share = 0.0 if isinstance(noise.fattening, UnsetType) else noise.fattening
    return round(share * (noise.window_px // 2))


class SensorSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Conversion of light to grey levels. The defaults are an ideal sensor of 8 bits."""

    exposure: Annotated[float, Meta(gt=0, le=100)] = 1.0  # times the light; white saturates
    full_well_e: Annotated[float, Meta(gt=0, le=1e7)] | None = None  # electrons at white
    read_noise_e: Annotated[float, Meta(ge=0, le=1e5)] = 0.0  # RMS, electrons
    bits: Literal[8, 12] = 8
    jpeg_quality: Annotated[int, Meta(ge=1, le=100)] | None = None  # None: no loss

    def __post_init__(self) -> None:
        """Reject combinations that no sensor has."""
        if self.read_noise_e > 0.0 and self.full_well_e is None:
            raise ValueError(
                "read_noise_e: expected full_well_e beside it (electrons at white), found none"
            )
        if self.jpeg_quality is not None and self.bits != 8:
            raise ValueError(f"jpeg_quality: expected bits = 8, found {self.bits}")
