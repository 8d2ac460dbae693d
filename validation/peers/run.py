"""Running a measure from elsewhere, by whatever way it is given."""

import hashlib
import inspect
import shlex
from pathlib import Path

import pandas as pd

from validation.errors import InputError
from validation.peers.command import run_command
from validation.peers.function import load_function
from validation.peers.spec import MeasureSpec
from validation.peers.view_input import Seen, as_table


def run_measure(spec: MeasureSpec, seen: Seen) -> pd.DataFrame:
    """Return one row for each rock of the labels: `rock`, the measure's columns, `reason`.

    Raises:
        InputError: the measure fails, or gives what is no number a rock.
    """
    where = f"--measure {spec.name}"
    if spec.command is not None:
        return as_table(run_command(spec.command, seen, where=where), seen.numbers, where=where)
    function = load_function(spec.function or "")
    try:
        given = function(seen.image, seen.labels, seen.points_m)
    except Exception as error:
        raise InputError(f"{where}: {type(error).__name__}: {error}") from error
    return as_table(given, seen.numbers, where=where)


def source_digest(spec: MeasureSpec) -> str:
    """Return a hash of the measure's source: its module's file, or the files a command names.

    What those call in turn does not count: after a change there, measure anew without --resume.
    """
    digest = hashlib.sha256()
    if spec.function is not None:
        source = inspect.getsourcefile(load_function(spec.function))
        files = [Path(source)] if source else []
    else:
        files = [Path(word) for word in shlex.split(spec.command or "")]
    for file in files:
        if file.is_file():
            digest.update(file.read_bytes())
    return digest.hexdigest()
