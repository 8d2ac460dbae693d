"""How long a user waits for the first number: fresh processes, imports and all.

Run `python benchmarks/cold_start.py`. `fresh` is the first run after an install that has compiled
nothing yet: every module is compiled from source into an empty cache. What it cannot show is a disk
that has not read the files before. Each has wall time and, after it, the processor's.
"""

import os
import resource
import statistics
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

EXAMPLES = Path(__file__).parent.parent / "examples"
ROUNDS = 5
COMMAND = [sys.executable, "-m", "rockshape.cli", "measure"]
MARS = [*COMMAND, "mars/i944014r.png", "--range", "mars/i944014r_xyz.npz"]
GRAINS = [*COMMAND, "grains/1_P1060330_1.jpg", "--labels", "grains/1_P1060330_1_mask.tif"]
WORK = (
    ("python -c pass", [sys.executable, "-c", "pass"]),
    ("import rockshape", [sys.executable, "-c", "import rockshape"]),
    ("import pandas, scipy.ndimage", [sys.executable, "-c", "import pandas, scipy.ndimage"]),
    ("measure mars, paper", [*MARS, "--method", "paper"]),
    ("measure mars, robust", [*MARS, "--method", "robust"]),
    ("measure grains, paper", [*GRAINS, "--method", "paper"]),
    ("measure grains, robust", [*GRAINS, "--method", "robust"]),
)


def seconds(command: list[str], cache: Path | None = None) -> tuple[float, float]:
    """Wall and processor time of one process, with a folder of its own for compiled modules."""
    environment = dict(os.environ)
    if cache is not None:
        environment["PYTHONPYCACHEPREFIX"] = str(cache)
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, check=True, capture_output=True, cwd=EXAMPLES, env=environment)
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """Print the table."""
    print(f"{'seconds':30s}{'fresh':>16s}{'later':>16s}")
    for title, command in WORK:
        with TemporaryDirectory() as cache:
            fresh = seconds(command, Path(cache))
        rounds = [seconds(command) for _ in range(ROUNDS)]
        later = [statistics.median(each) for each in zip(*rounds, strict=True)]
        cells = "".join(f"{wall:10.2f}{processor:6.2f}" for wall, processor in (fresh, later))
        print(f"{title:30s}{cells}", flush=True)


if __name__ == "__main__":
    main()
