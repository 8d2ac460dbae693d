"""Suites: experiments, and what their scores must reach; read from TOML."""

import tomllib
from importlib.resources import files
from pathlib import Path
from typing import Annotated, TypeVar

import msgspec
from msgspec import Meta, Struct, field

from validation.errors import InputError
from validation.peers import MeasureSpec, Name, Text, normalise_measures
from validation.suite.experiments import Experiment, SegmentationExperiment
from validation.suite.gates import Gate, GateFile
from validation.suite.inherit import resolve_likes


class Suite(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Experiments and the gates on their scores."""

    name: Name
    title: Text
    experiments: Annotated[tuple[Experiment, ...], Meta(min_length=1)] = field(name="experiment")
    gates: Annotated[tuple[Gate, ...], Meta(min_length=1)] = field(name="gate")
    measures: tuple[MeasureSpec, ...] = field(name="measure", default=())  # beside the methods

    def __post_init__(self) -> None:
        """Ask for names that differ: the scores' names begin with them."""
        for what, named in (("experiment", self.experiments), ("measure", self.measures)):
            names = [each.name for each in named]
            if len(set(names)) < len(names):
                raise ValueError(f"{what}: expected names that differ, found {', '.join(names)}")


def with_methods(suite: Suite, methods: tuple[str, ...]) -> Suite:
    """Return the suite with every experiment that measures measured by these methods."""
    return msgspec.structs.replace(
        suite,
        experiments=tuple(
            experiment
            if isinstance(experiment, SegmentationExperiment)
            else msgspec.structs.replace(experiment, methods=methods)
            for experiment in suite.experiments
        ),
    )


_T = TypeVar("_T")


def _convert(text: str, kind: type[_T], *, where: str) -> _T:
    try:
        table = normalise_measures(resolve_likes(tomllib.loads(text), where=where))
        return msgspec.convert(table, kind)
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
