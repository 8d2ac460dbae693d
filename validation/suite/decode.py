"""Decoding of plain tables, with errors that name the key and suggest the one that was meant."""

from collections.abc import Mapping
from typing import Any, TypeVar

import msgspec

from synth.spec.complaint import complaint
from validation.errors import InputError
from validation.suite.experiment import Experiment
from validation.suite.registry import kind_of_table

_T = TypeVar("_T")


def decode(table: object, record: type[_T], *, where: str, path: str = "") -> _T:
    """Table as a record; `path` is the table's own within the file.

    Raises:
        InputError: a key or value that is not allowed; the message names file, path and key.
    """
    try:
        return msgspec.convert(table, record)
    except UnicodeEncodeError as error:  # of lone surrogates, which JSON can hold
        raise InputError(f"{where}: expected text, found {error}") from error
    except msgspec.ValidationError as error:
        raise InputError(f"{where}: {complaint(table, record, path=path)}") from error


def decode_experiment(table: Mapping[str, Any], *, where: str, path: str) -> Experiment:
    """Suite's table of an experiment as the spec of its kind, also by an older name.

    Raises:
        InputError: no such kind, or a key or value that is not allowed.
    """
    try:
        kind = kind_of_table(table)
    except InputError as error:
        raise InputError(f"{where}: {path}.{error}") from error
    experiment = decode({**table, "kind": kind.name}, kind.spec, where=where, path=path)
    try:
        experiment.check()
    except InputError as error:
        raise InputError(f"{where}: {path}.{error}") from error
    return experiment
