"""The description of a dataset: every knob with unit, limits and default; read from TOML."""

import tomllib
from pathlib import Path
from typing import Annotated, Literal

import msgspec
from msgspec import Meta, Struct

from synth.errors import InputError

Family = Literal["rounded-polyhedron", "ellipsoid", "rounded-box", "perturbed", "mixed"]
Series = Literal["graded", "random"]
RendererName = Literal["auto", "osmesa", "egl", "embree"]
PresetName = Literal["imp", "msl-navcam"]

Positive = Annotated[float, Meta(gt=0, le=1000)]
Degrees = Annotated[float, Meta(ge=-360, le=360)]
Fraction = Annotated[float, Meta(ge=0, le=1)]
Ratio = Annotated[float, Meta(gt=0, le=1)]
PositiveRange = tuple[Positive, Positive]
RatioRange = tuple[Ratio, Ratio]
Seed = Annotated[int, Meta(ge=0, le=2**63 - 1)]
Count = Annotated[int, Meta(ge=1, le=500)]
Cuts = Annotated[int, Meta(ge=6, le=80)]
Rounding = Annotated[float, Meta(ge=0.005, le=5)]
Degree = Annotated[int, Meta(ge=1, le=60)]


def _check_range(name: str, limits: tuple[float, float]) -> None:
    """Raise ValueError unless limits are in rising order."""
    low, high = limits
    if not low <= high:
        raise ValueError(f"{name}: expected [low, high] with low <= high, found [{low}, {high}]")


class RocksSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """What lies on the ground. A pair is a range [low, high] that each rock's value is drawn from.

    `graded` gives all rocks of a scene the same half-axes and the same polyhedron, and spreads the
    rounding over its range; `random` draws everything for each rock.
    """

    count: Count = 6
    family: Family = "rounded-polyhedron"
    series: Series = "graded"
    diameter_m: PositiveRange = (0.28, 0.42)  # 2a, the longest side of the smallest box
    b_over_a: RatioRange = (0.72, 0.92)
    c_over_b: RatioRange = (0.65, 0.88)
    cuts: tuple[Cuts, Cuts] = (11, 15)
    rounding: tuple[Rounding, Rounding] = (0.02, 0.8)  # r over the inradius before rounding
    relief_rms: tuple[Fraction, Fraction] = (0.015, 0.045)  # over the cube root of abc
    relief_degrees: tuple[Degree, Degree] = (3, 14)  # spherical harmonics, both ends included
    albedo: RatioRange = (0.42, 0.62)
    spacing: Annotated[float, Meta(ge=1, le=10)] = 1.35  # least distance over the sum of radii

    def __post_init__(self) -> None:
        """Hold the ranges in order and the series to the families that have a rounding."""
        _check_range("diameter_m", self.diameter_m)
        _check_range("b_over_a", self.b_over_a)
        _check_range("c_over_b", self.c_over_b)
        _check_range("cuts", self.cuts)
        _check_range("rounding", self.rounding)
        _check_range("relief_rms", self.relief_rms)
        _check_range("relief_degrees", self.relief_degrees)
        _check_range("albedo", self.albedo)
        if self.series == "graded" and self.family not in ("rounded-polyhedron", "rounded-box"):
            raise ValueError(
                "series: 'graded' needs the family rounded-polyhedron or rounded-box, "
                f'found {self.family!r} (set series = "random")'
            )


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


class NoiseSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The range sensor's errors."""

    kind: Literal["none"] = "none"


class SceneSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A whole dataset. Scene i is a function of the spec and i alone."""

    seed: Seed = 0
    scenes: Annotated[int, Meta(ge=1, le=9999)] = 1
    renderer: RendererName = "auto"
    rocks: RocksSpec = RocksSpec()
    camera: CameraSpec = CameraSpec()
    views: ViewsSpec = ViewsSpec()
    sun: SunSpec = SunSpec()
    noise: NoiseSpec = NoiseSpec()


def load_spec(path: Path) -> SceneSpec:
    """Read a spec from a TOML file; what the file leaves out keeps its default.

    Raises:
        InputError: the file is missing, is no TOML, or holds a key or value that is not allowed.
    """
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path}: expected a TOML file, found {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: expected a TOML file, found bytes that are no text") from error
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{path}: expected TOML, found {error}") from error
    return convert_spec(table, where=str(path))


def convert_spec(table: object, *, where: str) -> SceneSpec:
    """Turn plain tables into a checked spec; `where` begins the complaint.

    Raises:
        InputError: a key or value that is not allowed; the message names it.
    """
    try:
        return msgspec.convert(table, SceneSpec)
    except msgspec.ValidationError as error:
        raise InputError(f"{where}: {error}") from error
