"""Runner of a measure from elsewhere: a function or a command."""

import hashlib
import math
import shlex
from pathlib import Path

import pandas as pd

from validation.errors import InputError
from validation.peers.command import run_command
from validation.peers.function_process import call_function, describe_function
from validation.peers.process import LIMIT_S
from validation.peers.spec import MeasureSpec
from validation.peers.view_input import Seen, as_table


def run_measure(spec: MeasureSpec, seen: Seen, *, limit_s: float = LIMIT_S) -> pd.DataFrame:
    """Table of one row a rock of the labels: `rock`, the measure's columns, `reason`.

    The measure runs in a process of its own.

    Raises:
        InputError: the measure fails, ends its process, takes longer than the limit, prints too
            much, or gives something other than a number a rock.
    """
    where = f"--measure {spec.name}"
    given: object
    if spec.command is not None:
        given = run_command(spec.command, seen, where=where, limit_s=limit_s)
    else:
        given = call_function(spec.function or "", seen, where=where, limit_s=limit_s)
    table = as_table(given, seen.numbers, where=where)
    missing = [column for column in spec.expected_trait if column not in table]
    if missing and len(table):
        found = ", ".join(str(name) for name in table if name not in ("rock", "reason"))
        raise InputError(f"{where}: expected the column {missing[0]}, found {found or 'none'}")
    return table.assign(**dict.fromkeys(missing, math.nan))


def declared_by(spec: MeasureSpec) -> dict[str, str]:
    """Traits by column that a measure's function declares; none for a command.

    Raises:
        InputError: the function cannot be imported.
    """
    if spec.function is None:
        return {}
    return describe_function(spec.function, limit_s=LIMIT_S).traits


def source_digest(spec: MeasureSpec) -> str:
    """SHA-256 of the measure's source: its module's file, or the files that a command names.

    Modules that those import are not hashed: after a change there, measure anew without --resume.
    """
    digest = hashlib.sha256()
    if spec.function is not None:
        source = describe_function(spec.function, limit_s=LIMIT_S).source
        files = [Path(source)] if source else []
    else:
        files = [Path(word) for word in shlex.split(spec.command or "")]
    for file in files:
        if file.is_file():
            digest.update(file.read_bytes())
    return digest.hexdigest()
