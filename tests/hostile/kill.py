"""Runs killed at random moments or out of disk space, then resumed: `python -m tests.hostile.kill`.

A killed run is started again with the same arguments (`--resume` for a validation). Its files then
hold the bytes of an undisturbed run, but for times; a file that was there before is never partial.
"""

import argparse
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from tests.hostile.cases import SUITE, usual_files

SPEC = (
    'scenes = 2\nrenderer = "embree"\n[rocks]\ncount = 2\nseries = "random"\n'
    'family = "rounded-box"\n[camera]\npreset = "imp"\nsupersample = 1\n[views]\ncount = 1\n'
)
TIMED = ("index.html", "junit.xml")  # tell how long the run took
SMALLEST_FILE_BYTES = 512


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


def _start(argv: list[str], file_bytes: int | None = None) -> "subprocess.Popen[str]":
    def limit() -> None:
        if file_bytes is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (file_bytes, file_bytes))

    return subprocess.Popen(
        [sys.executable, "-m", "rockshape.cli", *argv],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=limit,  # noqa: PLW1509 - no threads here
    )


def _content(out: Path) -> dict[str, bytes]:
    found = {path.relative_to(out).as_posix(): path for path in out.rglob("*") if path.is_file()}
    return {
        name: b"" if name in TIMED else path.read_bytes()
        for name, path in found.items()
        if not path.name.startswith(".")  # drafts of a killed run
    }


def _prepared(name: str, folder: Path, index: int) -> Path:
    out = folder / f"{name}{index}"
    if name == "measure":
        out.mkdir()
        for file in ("out.csv", "found.png", "over.png", "page.html"):
            (out / file).write_bytes(b"old")
    return out


def disturbed(name: str, *, times: int, seed: int, folder: Path, given: Path) -> list[str]:
    """Run a command, then as often disturbed by a SIGKILL and by a full disk; what went wrong."""
    command, rng = COMMANDS[name], np.random.default_rng(seed)
    calm = _prepared(name, folder, 0)
    began = time.monotonic()
    run = _start(command.argv(given, calm))
    if run.communicate()[1].count("Traceback") or run.returncode != 0:
        return [f"{name}: expected an undisturbed run, found status {run.returncode}"]
    took, whole = time.monotonic() - began, _content(calm)
    largest = max(len(data) for data in whole.values())
    wrong = []
    for index in range(1, 2 * times + 1):
        out = _prepared(name, folder, index)
        argv = command.argv(given, out)
        if index % 2:
            what = f"killed after {rng.uniform(0.02, 1.0) * took:.2f} s"
            run = _start(argv)
            try:
                run.communicate(timeout=float(what.split()[2]))
            except subprocess.TimeoutExpired:
                run.send_signal(signal.SIGKILL)
                run.communicate()
        else:
            limit = int(rng.integers(SMALLEST_FILE_BYTES, largest))
            what = f"files of at most {limit} bytes"
            run = _start(argv, limit)
            said = run.communicate()[1]
            if "Traceback" in said or run.returncode not in (0, 2, 3):
                wrong.append(f"{name}: {what}: status {run.returncode}: {said[-300:]}")
        kept = _content(out) if out.exists() else {}
        for file, data in kept.items():
            if name == "measure" and data not in (b"old", whole[file]):
                wrong.append(f"{name}: {what}: expected {file} old or whole, found a part")
        second = _start([*argv, *command.resume])
        said = second.communicate()[1]
        if second.returncode != 0:
            wrong.append(f"{name}: {what}: resumed with status {second.returncode}: {said[-300:]}")
        elif _content(out) != whole:
            wrong.append(f"{name}: {what}: expected the bytes of an undisturbed run, found others")
        shutil.rmtree(out, ignore_errors=True)
    return wrong


def main() -> int:
    """Disturb each command; 1 where something went wrong."""
    parser = argparse.ArgumentParser(prog="python -m tests.hostile.kill")
    parser.add_argument("--times", type=int, default=20, help="of each kind and command")
    parser.add_argument("--seed", type=int, default=0)
    args = parser.parse_args()
    wrong: list[str] = []
    with tempfile.TemporaryDirectory() as folder:
        given = Path(folder) / "given"
        given.mkdir()
        inputs(given)
        for name in COMMANDS:
            found = disturbed(
                name, times=args.times, seed=args.seed, folder=Path(folder), given=given
            )
            told = f"{len(found)} wrong" if found else "all resumed to the undisturbed bytes"
            print(f"{name}: {args.times} SIGKILLs and {args.times} full disks: {told}", flush=True)
            wrong += found
    print("\n".join(wrong))
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
