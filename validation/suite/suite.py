"""Suites: experiments, and what their scores must reach; read from TOML."""

import tomllib
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta, Struct, field

from synth.spec.wording import expected_one_of
from synth.text_file import read_text
from validation.errors import InputError
from validation.peers import MeasureSpec, Name, Text, normalise_measures
from validation.suite.decode import decode, decode_experiment
from validation.suite.experiment import Experiment
from validation.suite.gates import Gate, GateFile
from validation.suite.inherit import resolve_likes
from validation.suite.plugins import load_plugin
from validation.suite.shipped import suite_names


class Suite(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Experiments and the gates on their scores."""

    name: Name
    title: Text
    experiments: Annotated[tuple[Experiment, ...], Meta(min_length=1)] = field(name="experiment")
    gates: Annotated[tuple[Gate, ...], Meta(min_length=1)] = field(name="gate")
    measures: tuple[MeasureSpec, ...] = field(name="measure", default=())  # beside the methods
    plugins: tuple[Text, ...] = ()  # modules that register methods and kinds; or module:METHOD

    def __post_init__(self) -> None:
        """Ask for names that differ: the scores' names begin with them."""
        for what, named in (("experiment", self.experiments), ("measure", self.measures)):
            names = [each.name for each in named]
            if len(set(names)) < len(names):
                raise ValueError(f"{what}: expected names that differ, found {', '.join(names)}")


class _SuiteTable(Struct, forbid_unknown_fields=True, kw_only=True):
    """A suite whose experiments are still tables, as their kinds may come from its plug-ins.

    Its gates are read when the experiments have been, so that faults are told in this order.
    """

    name: Name
    title: Text
    experiments: Annotated[tuple[dict[str, Any], ...], Meta(min_length=1)] = field(
        name="experiment"
    )
    gate: Any = None
    measures: tuple[MeasureSpec, ...] = field(name="measure", default=())
    plugins: tuple[Text, ...] = ()


def as_suite(table: Mapping[str, Any], *, where: str) -> Suite:
    """Plain tables, as a suite's file or a run's scores.json has them, as a suite.

    Raises:
        InputError: a key or value that is not allowed, or a plug-in that cannot be imported.
    """
    plain = normalise_measures(resolve_likes(dict(table), where=where))
    head = decode(plain, _SuiteTable, where=where)
    for plugin in head.plugins:
        load_plugin(plugin)
    experiments = tuple(
        decode_experiment(each, where=where, path=f"experiment[{index}]")
        for index, each in enumerate(head.experiments)
    )
    given = {key: value for key, value in plain.items() if key == "gate"}
    gates = decode(given, GateFile, where=where).gate
    try:
        return Suite(
            name=head.name,
            title=head.title,
            experiments=experiments,
            gates=gates,
            measures=head.measures,
            plugins=head.plugins,
        )
    except ValueError as error:
        raise InputError(f"{where}: {error}") from error


def _parse(text: str, *, where: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError(f"{where}: expected TOML, found {error}") from error


def _read(path: Path) -> str:
    try:
        return read_text(path)
    except OSError as error:
        raise InputError(f"{path}: expected a TOML file, found {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: expected a TOML file, found bytes that are no text") from error


def load_suite(name_or_path: str) -> Suite:
    """Read a suite by its name or, when it ends in `.toml`, from a file.

    Raises:
        InputError: no such suite or file, or a key or value that is not allowed.
    """
    if name_or_path.endswith(".toml"):
        return as_suite(_parse(_read(Path(name_or_path)), where=name_or_path), where=name_or_path)
    if name_or_path not in suite_names():
        raise InputError(
            f"suite (--suite): {expected_one_of(name_or_path, suite_names())}; "
            "or name a file ending in .toml"
        )
    text = (files("validation") / "suites" / f"{name_or_path}.toml").read_text(encoding="utf-8")
    where = f"suite {name_or_path}"
    return as_suite(_parse(text, where=where), where=where)


def load_gates(path: Path) -> tuple[Gate, ...]:
    """Read a file of gates alone.

    Raises:
        InputError: no such file, or a key or value that is not allowed.
    """
    return decode(_parse(_read(path), where=str(path)), GateFile, where=str(path)).gate
