"""Many frames in one process, flat in memory and handles: `python -m tests.hostile.soak FRAMES`."""

import argparse
import re
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

import rockshape
from tests.hostile.cases import usual_files

WARM_UP = 20  # frames, in which caches fill
MAX_GROWTH_BYTES = 48 * 2**20


class Use(NamedTuple):
    """What a process holds."""

    resident_bytes: int
    threads: int
    handles: int


def used() -> Use:
    """Use of this process now."""
    text = Path("/proc/self/status").read_text(encoding="utf-8")
    numbers = {key: int(re.search(rf"{key}:\s+(\d+)", text)[1]) for key in ("VmRSS", "Threads")}
    return Use(
        1024 * numbers["VmRSS"], numbers["Threads"], len(list(Path("/proc/self/fd").iterdir()))
    )


def soak(frames: int) -> tuple[Use, Use]:
    """Use after the first frames and after all, each read from files and measured."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, data in usual_files().items():
            (folder / file).write_bytes(data)
        before = used()
        for frame in range(WARM_UP + frames):
            observation = rockshape.read(
                folder / "scene.png",
                range=folder / "range.npy",
                camera=folder / "camera.json",
                labels=folder / "labels.png",
            )
            rockshape.measure(observation, method=("robust", "paper")[frame % 2], descriptors=True)
            if frame == WARM_UP - 1:
                before = used()
        return before, used()


def main() -> int:
    """Soak from the command line; 1 where something grows."""
    parser = argparse.ArgumentParser(prog="python -m tests.hostile.soak")
    parser.add_argument("frames", type=int)
    before, after = soak(parser.parse_args().frames)
    growth = after.resident_bytes - before.resident_bytes
    print(
        f"resident {before.resident_bytes / 2**20:.0f} → {after.resident_bytes / 2**20:.0f} MiB, "
        f"threads {before.threads} → {after.threads}, handles {before.handles} → {after.handles}"
    )
    flat = growth <= MAX_GROWTH_BYTES and after.threads <= before.threads
    return int(not (flat and after.handles <= before.handles))


if __name__ == "__main__":
    sys.exit(main())
