"""How long a user waits for the first number: fresh processes, imports and all.

Run `python benchmarks/cold_start.py`. `fresh` is the first run after an install that has compiled
nothing yet: every module is compiled from source into an empty cache. What it cannot show is a disk
that has not read the files before.
"""

import os
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


def seconds(command: list[str], cache: Path | None = None) -> float:
    """One process from start to end, with the cache of compiled modules in a folder of its own."""
    environment = dict(os.environ)
    if cache is not None:
        environment["PYTHONPYCACHEPREFIX"] = str(cache)
    start = time.perf_counter()
    subprocess.run(command, check=True, capture_output=True, cwd=EXAMPLES, env=environment)
    return time.perf_counter() - start


def main() -> None:
    """Print the table."""
    print(f"{'s':30s}{'fresh':>8s}{'later':>8s}")
    for title, command in WORK:
        with TemporaryDirectory() as cache:
            fresh = seconds(command, Path(cache))
        later = statistics.median(seconds(command) for _ in range(ROUNDS))
        print(f"{title:30s}{fresh:8.2f}{later:8.2f}", flush=True)


if __name__ == "__main__":
    main()
