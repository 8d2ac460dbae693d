"""Runner of a measure from elsewhere: a function or a command."""

import hashlib
import inspect
import shlex
from pathlib import Path

import pandas as pd

from validation.peers.call import call_measure
from validation.peers.command import run_command
from validation.peers.function import load_function
from validation.peers.spec import MeasureSpec
from validation.peers.view_input import Seen, as_table


def run_measure(spec: MeasureSpec, seen: Seen) -> pd.DataFrame:
    """Table of one row a rock of the labels: `rock`, the measure's columns, `reason`.

    Raises:
        InputError: the measure fails, or gives something other than a number a rock.
    """
    where = f"--measure {spec.name}"
    if spec.command is not None:
        return as_table(run_command(spec.command, seen, where=where), seen.numbers, where=where)
    function = load_function(spec.function or "")
    return as_table(call_measure(function, seen, where=where), seen.numbers, where=where)


def source_digest(spec: MeasureSpec) -> str:
    """SHA-256 of the measure's source: its module's file, or the files that a command names.

    Modules that those import are not hashed: after a change there, measure anew without --resume.
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
