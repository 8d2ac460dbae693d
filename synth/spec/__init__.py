"""Dataset specification: every parameter with its unit, limits and default; read from TOML."""

from pathlib import Path
from typing import Annotated, Literal

from msgspec import UNSET, Meta, Struct, UnsetType

from synth.spec.calibration import CalibrationSpec
from synth.spec.convert import convert_table
from synth.spec.dataset import DatasetSpec
from synth.spec.ground import GroundSpec
from synth.spec.image import ImageSpec
from synth.spec.light import LightSpec
from synth.spec.population import PopulationSpec
from synth.spec.rocks import RocksSpec
from synth.spec.sensor import NoiseSpec, SensorSpec
from synth.spec.site import with_site
from synth.spec.surface import SurfaceSpec
from synth.spec.things import ThingsSpec
from synth.spec.tints import TintsSpec
from synth.spec.toml import read_toml
from synth.spec.truth import TruthSpec
from synth.spec.view import CameraSpec, SunSpec, ViewsSpec

RendererName = Literal["auto", "osmesa", "egl", "embree"]
MAX_SCENES = 9999
Seed = Annotated[int, Meta(ge=0, le=2**63 - 1)]


class SceneSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Specification of a dataset. Scene i is a function of the spec and i alone.

    It is complete in itself: without a table `ground.terrain` the ground is plain. Sites, which
    bring one, are laid under what a TOML file or the arguments of `make_scene` say.
    """

    seed: Seed = 0
    scenes: Annotated[int, Meta(ge=1, le=MAX_SCENES)] = 1
    renderer: RendererName = "auto"
    rocks: RocksSpec = RocksSpec()
    population: PopulationSpec = PopulationSpec()
    ground: GroundSpec = GroundSpec()
    surface: SurfaceSpec = SurfaceSpec()
    camera: CameraSpec = CameraSpec()
    views: ViewsSpec = ViewsSpec()
    sun: SunSpec = SunSpec()
    noise: NoiseSpec = NoiseSpec()
    sensor: SensorSpec = SensorSpec()
    # not written to manifests unless they are given:
    calibration: CalibrationSpec | UnsetType = UNSET
    image: ImageSpec | UnsetType = UNSET
    light: LightSpec | UnsetType = UNSET
    tints: TintsSpec | UnsetType = UNSET
    things: ThingsSpec | UnsetType = UNSET
    dataset: DatasetSpec | UnsetType = UNSET
    truth: TruthSpec | UnsetType = UNSET

    def __post_init__(self) -> None:
        """Reject counted rocks on a pan: none could lie in every view."""
        if self.views.path == "pan" and self.population.kind == "count":
            raise ValueError(
                'views.path: \'pan\' needs population.kind = "golombek-rapp", found "count"'
            )


def dataset_of(spec: SceneSpec) -> DatasetSpec:
    """Parameters of the dataset as a whole: the spec's, or the defaults."""
    return DatasetSpec() if isinstance(spec.dataset, UnsetType) else spec.dataset


def truth_of(spec: SceneSpec) -> TruthSpec:
    """Further truth that is asked for: the spec's, or none."""
    return TruthSpec() if isinstance(spec.truth, UnsetType) else spec.truth


def image_of(spec: SceneSpec) -> ImageSpec:
    """Parameters of the pictures: the spec's, or the defaults."""
    return ImageSpec() if isinstance(spec.image, UnsetType) else spec.image


def light_of(spec: SceneSpec) -> LightSpec:
    """Ranges and colours of the light: the spec's, or none."""
    return LightSpec() if isinstance(spec.light, UnsetType) else spec.light


def tints_of(spec: SceneSpec) -> TintsSpec | UnsetType:
    """Colours of surfaces: the spec's, or the defaults where it asks for colour pictures."""
    return TintsSpec() if spec.tints is UNSET and image_of(spec).colour else spec.tints


def load_spec(path: Path) -> SceneSpec:
    """Specification read from a TOML file; keys that it leaves out are those of its site.

    Raises:
        SpecError: the file is missing, is no TOML, or holds a key or value that is not allowed.
    """
    return convert_spec(with_site(read_toml(path), where=str(path)), where=str(path))


def convert_spec(table: object, *, where: str) -> SceneSpec:
    """Specification converted from plain tables and checked; `where` begins the complaint.

    Raises:
        SpecError: a key or value that is not allowed; the message names it.
    """
    return convert_table(table, SceneSpec, where=where)
