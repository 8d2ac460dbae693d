"""Suites: what is made, what is measured, and what the scores must reach; read from TOML."""

import tomllib
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Literal, TypeVar

import msgspec
from msgspec import Meta, Struct, field

from synth.spec import SceneSpec
from validation.errors import InputError
from validation.gates import Gate, GateFile

Name = Annotated[str, Meta(pattern="^[a-z][a-z0-9_-]*$")]
Text = Annotated[str, Meta(min_length=1)]
Seed = Annotated[int, Meta(ge=0, lt=2**32)]
Method = Literal["paper"]
Varied = Literal["angularity", "form"]
ShapeSeries = Literal["roundness", "sphericity"]


class YardExperiment(
    Struct, frozen=True, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="yard"
):
    """Rocks seen from several views, as in the paper's figure 10, but with truth.

    Scene i of the experiment is scene 0 of `scene` with the seed `seed` + i.
    """

    name: Name
    title: Text
    seed: Seed
    scenes: Annotated[int, Meta(ge=1, le=9999)]
    varied: Annotated[tuple[Varied, ...], Meta(min_length=1)]  # truths that differ between rocks
    scene: SceneSpec = SceneSpec()
    method: Method = "paper"
    min_visible_fraction: Annotated[float, Meta(ge=0, le=1)] = 0.8
    min_iou: Annotated[float, Meta(gt=0, le=1)] = 0.5
    pictured: Annotated[int, Meta(ge=0, le=12)] = 1  # scenes shown in the report

    def __post_init__(self) -> None:
        """Leave one place for the seed and for the number of scenes."""
        if self.scene.seed != 0 or self.scene.scenes != 1:
            raise ValueError(
                f"experiment {self.name!r}: expected seed and scenes beside its name, "
                "found one of them under scene"
            )


class ShapesExperiment(
    Struct, frozen=True, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="shapes"
):
    """Hand-drawn shapes in series, as in the paper's figures 8 and 9.

    Drawing i of a series has the seed `seed` + i.
    """

    name: Name
    title: Text
    seed: Seed
    drawings: Annotated[int, Meta(ge=1, le=9999)]
    series: Annotated[tuple[ShapeSeries, ...], Meta(min_length=1)] = ("roundness", "sphericity")
    count: Annotated[int, Meta(ge=3, le=12)] = 4
    method: Method = "paper"


Experiment = YardExperiment | ShapesExperiment


class Suite(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Experiments and the gates on their scores."""

    name: Name
    title: Text
    experiments: Annotated[tuple[Experiment, ...], Meta(min_length=1)] = field(name="experiment")
    gates: Annotated[tuple[Gate, ...], Meta(min_length=1)] = field(name="gate")

    def __post_init__(self) -> None:
        """Ask for experiments whose names differ: the scores' names begin with them."""
        names = [experiment.name for experiment in self.experiments]
        if len(set(names)) < len(names):
            raise ValueError(f"experiment: expected names that differ, found {', '.join(names)}")


_T = TypeVar("_T")


def _convert(text: str, kind: type[_T], *, where: str) -> _T:
    try:
        return msgspec.convert(tomllib.loads(text), kind)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{where}: expected TOML, found {error}") from error
    except msgspec.ValidationError as error:
        raise InputError(f"{where}: {error}") from error


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{path}: expected a TOML file, found {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: expected a TOML file, found bytes that are no text") from error


def suite_names() -> tuple[str, ...]:
    """Return the names of the suites that come with the package."""
    names = [file.name for file in (files("validation") / "suites").iterdir()]
    return tuple(sorted(name.removesuffix(".toml") for name in names if name.endswith(".toml")))


def load_suite(name_or_path: str) -> Suite:
    """Read a suite by its name or, when it ends in `.toml`, from a file.

    Raises:
        InputError: no such suite or file, or a key or value that is not allowed.
    """
    if name_or_path.endswith(".toml"):
        return _convert(_read(Path(name_or_path)), Suite, where=name_or_path)
    if name_or_path not in suite_names():
        known = ", ".join(suite_names())
        raise InputError(
            f"--suite: expected one of {known} or a file ending in .toml, found {name_or_path!r}"
        )
    text = (files("validation") / "suites" / f"{name_or_path}.toml").read_text(encoding="utf-8")
    return _convert(text, Suite, where=f"suite {name_or_path}")


def load_gates(path: Path) -> tuple[Gate, ...]:
    """Read a file of gates alone.

    Raises:
        InputError: no such file, or a key or value that is not allowed.
    """
    return _convert(_read(path), GateFile, where=str(path)).gate
