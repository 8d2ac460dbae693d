"""Runner of a measure that is a command: it reads image files and writes a CSV."""

import shlex
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

import cv2
import numpy as np
import pandas as pd

from validation.errors import InputError
from validation.peers.process import ForeignProcess
from validation.peers.view_input import Seen

PLACES = ("{image}", "{labels}", "{range}", "{out}")
NEEDED = ("{labels}", "{out}")
MAX_CSV_BYTES = 2**26
MAX_UINT16 = 2**16 - 1


def check_command(command: str) -> None:
    """Refuse a command that cannot be split into words, or lacks a placeholder that it needs.

    Raises:
        InputError: says which word is missing.
    """
    try:
        words = shlex.split(command)
    except ValueError as error:
        raise InputError(f"--measure: expected a command, found {command!r}: {error}") from error
    for place in NEEDED:
        if not any(place in word for word in words):
            raise InputError(f"--measure: expected {place} in the command, found {command!r}")


def _filled(word: str, texts: Mapping[str, str]) -> str:
    """Word of a command with the texts of the places in it."""
    for place, text in texts.items():
        word = word.replace(place, text)
    return word


def run_command(command: str, seen: Seen, *, where: str, limit_s: float) -> pd.DataFrame:
    """Table that a command writes to {out}, a CSV with the column `rock`.

    {image} becomes an 8-bit PNG, {labels} a 16-bit PNG, {range} an .npz with `xyz` (rows, cols, 3)
    in metres, or an empty word without range. No shell takes part.

    Raises:
        InputError: the command cannot be run, fails, takes longer than the limit, prints too much,
            or writes no such table.
    """
    if seen.labels.max(initial=0) > MAX_UINT16:
        raise InputError(f"{where}: expected labels of 16 bits, found {seen.labels.max()}")
    with TemporaryDirectory(prefix="rockshape-measure-") as folder:
        files = {place: Path(folder) / name for place, name in zip(PLACES, _NAMES, strict=True)}
        cv2.imwrite(str(files["{image}"]), np.rint(255 * seen.image.clip(0, 1)).astype(np.uint8))
        cv2.imwrite(str(files["{labels}"]), seen.labels.astype(np.uint16))
        words = {place: str(path) for place, path in files.items()}
        if seen.points_m is None:
            words["{range}"] = ""
        else:
            np.savez(files["{range}"], xyz=seen.points_m)
        argv = [_filled(word, words) for word in shlex.split(command)]
        ForeignProcess(argv, where=where).finish(limit_s)
        try:
            size = files["{out}"].stat().st_size
            table = pd.read_csv(files["{out}"]) if size <= MAX_CSV_BYTES else None
        except (OSError, ValueError) as error:
            raise InputError(f"{where}: expected a CSV at {{out}}, found: {error}") from error
    if table is None:
        raise InputError(f"{where}: expected a CSV of up to {MAX_CSV_BYTES} bytes, found {size}")
    if "rock" not in table:
        raise InputError(f"{where}: expected the column rock, found {', '.join(table.columns)}")
    return table


_NAMES = ("image.png", "labels.png", "range.npz", "out.csv")
