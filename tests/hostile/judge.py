"""Outcome of a hostile case: what a run may do, measured in the process that runs it."""

import os
import re
import resource
import shutil
import sys
import tempfile
import time
import traceback
from pathlib import Path
from typing import NamedTuple

from tests.hostile.cases import OUTPUTS, Case, damaged_run, usual_files
from tests.hostile.seed_files import labels as label_files

LIMIT_S = 10.0
GRACE_S = 3 * LIMIT_S  # on a loaded machine
MAX_GROWTH_BYTES = 2**30
MAX_LINE = 500
ADDRESS_SPACE_BYTES = 12 * 2**30
_CHATTER = re.compile(r"Traceback|libpng|libjpeg|TIFFRead|Warning:|WARN|OpenCV", re.IGNORECASE)


class Verdict(NamedTuple):
    """Outcome of a case: `done`, `refused`, or what is forbidden."""

    outcome: str
    seconds: float
    growth_bytes: int
    said: str


class Stopwatch:
    """Time that counts: the processor's, since other processes take their share of the machine.

    Beyond the grace it is the wall clock's, for what waits for ever takes no processor.
    """

    def __init__(self) -> None:
        self._wall, self._processor = time.monotonic(), time.process_time()

    def seconds(self) -> float:
        """Seconds since the start."""
        wall = time.monotonic() - self._wall
        return wall if wall > GRACE_S else time.process_time() - self._processor


class Bench:
    """Folder of the usual files in which cases are run, one after another."""

    def __init__(self, run: Path | None = None) -> None:
        """Make the folder; `run` is a validation run that comparisons begin with."""
        self.folder = Path(tempfile.mkdtemp(prefix="hostile-"))
        masks = {f"masks/{name}": data for name, data in label_files.masks().items()}
        self._usual = usual_files() | masks
        (self.folder / "folder").mkdir()
        (self.folder / "masks").mkdir()
        for name, data in self._usual.items():
            (self.folder / name).write_bytes(data)
        if run is not None:
            shutil.copytree(run, self.folder / "run")
            shutil.copytree(run, self.folder / "bad run")
        os.chdir(self.folder)

    def close(self) -> None:
        """Remove the folder."""
        shutil.rmtree(self.folder, ignore_errors=True)

    def judge(self, case: Case) -> Verdict:
        """Run a case in this process."""
        for name, data in case.files.items():
            (self.folder / name).write_bytes(self._data(name, data))
        argv = [
            re.sub(r"\{([^{}]+)\}", lambda m: str(self.folder / m[1]), word) for word in case.argv
        ]
        before, watch = peak_bytes(reset=True), Stopwatch()
        status, out, err = _captured(argv)
        seconds, growth = watch.seconds(), peak_bytes() - before
        changed = [
            name for name, data in self._usual.items() if _content(self.folder / name) != data
        ]
        outcome = _outcome(status, out, err, changed)
        rendered = case.command == "validate run" and outcome == "done"  # takes the time it takes
        if seconds > LIMIT_S and not rendered:
            outcome = "hang"
        elif growth > MAX_GROWTH_BYTES:
            outcome = "memory"
        self._restore(case, changed)
        return Verdict(outcome, seconds, growth, err or out[:200])

    def _data(self, name: str, data: bytes) -> bytes:
        if not name.startswith("bad run/"):
            return data
        return damaged_run(name, (self.folder / "run" / Path(name).name).read_bytes(), data)

    def _restore(self, case: Case, changed: list[str]) -> None:
        for name in case.files:
            path = self.folder / name
            if name.startswith("bad run/"):
                shutil.copy(self.folder / "run" / path.name, path)
            else:
                path.unlink(missing_ok=True)
        for name in changed:
            (self.folder / name).write_bytes(self._usual[name])


def _content(path: Path) -> bytes | None:
    return path.read_bytes() if path.is_file() else None


def _outcome(status: int | str, out: str, err: str, changed: list[str]) -> str:
    if isinstance(status, str):
        return "traceback"
    lines = err.splitlines()
    if set(changed) - set(OUTPUTS):
        return "overwritten"
    if status == 2:
        if changed:
            return "overwritten"
        good = len(lines) == 1 and len(lines[0]) <= MAX_LINE + 60 and not out
        return "refused" if good else "extra lines"
    if status in (0, 1, 3):
        return "extra lines" if _CHATTER.search(err) else "done" if status < 2 else "refused"
    return f"status {status}"


def peak_bytes(*, reset: bool = False) -> int:
    """Largest resident size since the last reset (VmHWM)."""
    if reset:
        try:
            Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
        except OSError:
            return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    text = Path("/proc/self/status").read_text(encoding="utf-8")
    found = re.search(r"VmHWM:\s+(\d+) kB", text)
    return int(found[1]) * 1024 if found else 0


def _captured(argv: list[str]) -> tuple[int | str, str, str]:
    """Exit status (or a traceback), output and error output, of the C libraries too."""
    from rockshape.cli import main

    sys.stdout.flush()
    sys.stderr.flush()
    saved = os.dup(1), os.dup(2)
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        os.dup2(out.fileno(), 1)
        os.dup2(err.fileno(), 2)
        streams = sys.stdout, sys.stderr
        sys.stdout = os.fdopen(1, "w", encoding="utf-8", closefd=False)
        sys.stderr = os.fdopen(2, "w", encoding="utf-8", closefd=False)
        try:
            status: int | str = main(argv)
        except SystemExit as left:
            status = left.code if isinstance(left.code, int) else 0 if left.code is None else 1
        except BaseException:
            status = traceback.format_exc()
        finally:
            for stream in (sys.stdout, sys.stderr):
                if stream is not None:
                    stream.flush()
            sys.stdout, sys.stderr = streams
            for target, descriptor in enumerate(saved, start=1):
                os.dup2(descriptor, target)
                os.close(descriptor)
        found = []
        for file in (out, err):
            file.seek(0)
            found.append(file.read(10**6).decode(errors="replace"))
    if isinstance(status, str):
        found[1] = status
    return status, found[0], found[1]
