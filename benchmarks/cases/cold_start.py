"""Time to the first number: whole processes, imports and all."""

import os
from pathlib import Path
from sys import executable
from tempfile import TemporaryDirectory

from case import Case, Column, Table
from timing import NEVER, timed_command

EXAMPLES = Path(__file__).parents[2] / "examples"
MEASURE = [executable, "-m", "rockshape.cli", "measure"]
MARS = [*MEASURE, "mars/i944014r.png", "--range", "mars/i944014r_xyz.npz"]
GRAINS = [*MEASURE, "grains/1_P1060330_1.jpg", "--labels", "grains/1_P1060330_1_mask.tif"]
COMMANDS = {
    "python -c pass": [executable, "-c", "pass"],
    "import rockshape": [executable, "-c", "import rockshape"],
    "rockshape --version": [executable, "-m", "rockshape.cli", "--version"],
    "import pandas, scipy.ndimage": [executable, "-c", "import pandas, scipy.ndimage"],
    "measure mars, paper": [*MARS, "--method", "paper"],
    "measure mars, robust": [*MARS, "--method", "robust"],
    "measure grains, paper": [*GRAINS, "--method", "paper"],
    "measure grains, robust": [*GRAINS, "--method", "robust"],
}


def processes(*, rounds: int = 4, first: int = 99) -> list[Table]:
    """Time each command with nothing compiled yet, and again."""
    rows = []
    for title, command in list(COMMANDS.items())[:first]:
        with TemporaryDirectory() as cache:
            environment = os.environ | {"PYTHONPYCACHEPREFIX": cache}
            options = {"capture_output": True, "cwd": EXAMPLES}
            fresh = timed_command(command, env=environment, **options)
        later = NEVER
        for _ in range(rounds):
            later = later.least(timed_command(command, **options))
        rows.append((title, fresh.cpu_s, fresh.wall_s, later.cpu_s, later.wall_s))
    heads = [
        Column(f"{when}, {clock}", "s", ".2f")
        for when in ("fresh", "later")
        for clock in ("processor", "wall")
    ]
    return [Table((Column("process"), *heads), rows)]


COLD_START_CASE = Case(
    name="cold_start",
    what="whole processes; fresh: every module compiled from source into an empty cache",
    run=processes,
    smallest={"rounds": 1, "first": 2},
)
