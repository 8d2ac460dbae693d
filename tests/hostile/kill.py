"""Runs killed at random moments or out of disk space, then resumed: `python -m tests.hostile.kill`.

A killed run is started again with the same arguments (`--resume` for a validation). Its files then
hold the bytes of an undisturbed run, but for times; a file that was there before is never partial.
"""

import argparse
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from functools import partial
from itertools import product
from pathlib import Path
from typing import NamedTuple

import numpy as np

from tests.hostile.cases import SUITE, usual_files
from tests.hostile.disturbances import WAYS, Run, Way, can_mount, start

SPEC = (
    'site = "plain"\nscenes = 2\nrenderer = "embree"\n[rocks]\ncount = 2\nseries = "random"\n'
    'family = "rounded-box"\n[camera]\npreset = "imp"\nsupersample = 1\n[views]\ncount = 1\n'
)
TIMED = ("index.html", "junit.xml")  # tell how long the run took


class Command(NamedTuple):
    """Command that writes into a folder."""

    argv: Callable[[Path, Path], list[str]]  # of the folder of inputs and that of outputs
    resume: tuple[str, ...]


COMMANDS = {
    "synth": Command(
        lambda given, out: ["synth", "scene", "--spec", str(given / "spec.toml"), str(out)], ()
    ),
    "validate": Command(
        lambda given, out: [
            *("validate", "run", "--jobs", "1", "--suite", str(given / "suite.toml")),
            *("--out", str(out)),
        ],
        ("--resume",),
    ),
    "measure": Command(
        lambda given, out: [
            *("measure", str(given / "scene.png"), "--labels", str(given / "labels.png")),
            *("--out", str(out / "out.csv"), "--labels-out", str(out / "found.png")),
            *("--overlay", str(out / "over.png"), "--report", str(out / "page.html")),
        ],
        (),
    ),
}


def inputs(folder: Path) -> Path:
    """Folder of the inputs of all commands."""
    for name, data in {**usual_files(), "suite.toml": SUITE, "spec.toml": SPEC.encode()}.items():
        (folder / name).write_bytes(data)
    return folder


def _content(out: Path) -> dict[str, bytes]:
    found = {path.relative_to(out).as_posix(): path for path in out.rglob("*") if path.is_file()}
    return {
        name: b"" if name in TIMED else path.read_bytes()
        for name, path in found.items()
        if not path.name.startswith(".")  # drafts of a killed run
    }


def _prepare(name: str, out: Path) -> None:
    """Old outputs, where there are some before a run."""
    if name == "measure":
        out.mkdir()
        for file in ("out.csv", "out.csv.meta.json", "found.png", "over.png", "page.html"):
            (out / file).write_bytes(b"old")


class Calm(NamedTuple):
    """What an undisturbed run takes and writes."""

    took_s: float
    sizes: list[int]  # of its files, bytes
    content: dict[str, bytes]  # of its files, by path


def undisturbed(name: str, *, folder: Path, given: Path) -> Calm:
    """Run a command once and remove what it wrote.

    Raises:
        RuntimeError: the run fails.
    """
    out = folder / f"{name} calm"
    _prepare(name, out)
    began = time.monotonic()
    run = start(COMMANDS[name].argv(given, out))
    if run.communicate()[1].count("Traceback") or run.returncode != 0:
        raise RuntimeError(f"{name}: expected an undisturbed run, found status {run.returncode}")
    took_s, content = time.monotonic() - began, _content(out)
    sizes = [path.stat().st_size for path in out.rglob("*") if path.is_file()]
    shutil.rmtree(out)
    return Calm(took_s, sizes, content)


def disturbed(
    name: str, way: Way, calm: Calm, *, times: int, seed: int, folder: Path, given: Path
) -> Iterator[str]:
    """Run a command so often, disturbed in one way and resumed; what went wrong."""
    command, rng = COMMANDS[name], np.random.default_rng(seed)
    whole = calm.content
    for index in range(times):
        place = folder / f"{name} {index}"
        place.mkdir()
        out = place / "out"
        argv = command.argv(given, out)
        run = Run(argv, place, partial(_prepare, name, out), calm.took_s, calm.sizes)
        with way(run, rng) as done:
            found = [done.wrong, *_partial(name, out, whole), _resumed(command, argv, out, whole)]
        yield from (f"{done.what}: {each}" for each in found if each)
        shutil.rmtree(place)


def _partial(name: str, out: Path, whole: dict[str, bytes]) -> Iterator[str]:
    """Old outputs that are neither old nor whole."""
    if name == "measure":
        found = _content(out)
        for file, data in whole.items():
            if found.get(file) not in (b"old", data):
                yield f"expected {file} old or whole, found another"


def _resumed(command: Command, argv: list[str], out: Path, whole: dict[str, bytes]) -> str:
    """What is wrong with a run that is started again."""
    second = start([*argv, *command.resume])
    said = second.communicate()[1]
    if second.returncode != 0:
        return f"resumed with status {second.returncode}: {said[-300:]!r}"
    return "" if _content(out) == whole else "expected the bytes of an undisturbed run"


def main() -> int:
    """Disturb each command in each way; 1 where something went wrong."""
    parser = argparse.ArgumentParser(prog="python -m tests.hostile.kill")
    parser.add_argument("--times", type=int, default=20, help="of each way and command")
    parser.add_argument("--seed", type=int, default=0)
    args = parser.parse_args()
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        given = Path(folder) / "given"
        given.mkdir()
        inputs(given)
        ways = dict(WAYS)
        if not can_mount(given):
            print("full disks: left out, for no filesystem can be mounted here")
            del ways["full disks"]
        place = {"folder": Path(folder), "given": given}
        calm = {name: undisturbed(name, **place) for name in COMMANDS}
        for name, (told, way) in product(COMMANDS, ways.items()):
            found = list(
                disturbed(name, way, calm[name], times=args.times, seed=args.seed, **place)
            )
            end = f"{len(found)} wrong" if found else "all resumed to the undisturbed bytes"
            print("\n".join([f"{name}: {args.times} {told}: {end}", *found]), flush=True)
            failed |= bool(found)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
