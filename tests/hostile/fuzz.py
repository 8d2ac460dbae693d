"""Fuzzers of every reader and of `rockshape.measure`: `python -m tests.hostile.fuzz MINUTES`.

Hypothesis draws the damage and shrinks what it finds. A reader may return or raise InputError; so
may `measure`. Anything else, more than 10 s or 1 GB among it, is a find: it is printed and written
to reports/fuzz, from where it becomes a test.
"""

import argparse
import faulthandler
import functools
import signal
import sys
import tempfile
import time
import warnings
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

import rockshape
from rockshape.camera.lens import DisparityScale, Lens
from rockshape.errors import InputError
from rockshape.io import read_image, read_labels, read_lens, read_pair, read_points
from rockshape.point_grid.range_kinds import RangeKind
from tests.hostile.judge import GRACE_S, LIMIT_S, MAX_GROWTH_BYTES, Stopwatch, peak_bytes
from tests.hostile.scene import CAMERA, SHAPE, image
from tests.hostile.seed_files import ranges
from tests.hostile.seeds import Seed
from tests.hostile.strategies import RANGE_KINDS, damaged_files, damaged_masks, observations

MAX_FINDS = 50
TICK_S = 1.0  # between alarms after the first
EXAMPLES = {"readers": 450, "pairs": 60, "folders": 100, "measure": 300}  # a round
COUNTS: Counter[tuple[str, str]] = Counter()  # by what was tried and its outcome


@contextmanager
def limited(what: str) -> Iterator[None]:
    """Fail where what is done takes longer or more memory than may be; InputError is allowed.

    The alarm ends a loop, again and again where what it raises is swallowed; the stopwatch tells
    afterwards. What no alarm ends, a loop in C, ends the process with its stack.
    """
    before, watch = peak_bytes(reset=True), Stopwatch()

    def tick(*_: object) -> None:
        if watch.seconds() > LIMIT_S:
            raise TimeoutError(f"no end within {LIMIT_S} s")

    signal.signal(signal.SIGALRM, tick)
    signal.setitimer(signal.ITIMER_REAL, LIMIT_S, TICK_S)
    faulthandler.dump_traceback_later(2 * GRACE_S, exit=True)
    try:
        yield
        COUNTS[what, "taken"] += 1
    except InputError as error:
        COUNTS[what, "refused"] += 1
        assert str(error).strip()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        faulthandler.cancel_dump_traceback_later()
        seconds, growth = watch.seconds(), peak_bytes() - before
        COUNTS[what, "late"] += seconds > LIMIT_S
    assert seconds <= LIMIT_S, f"expected an end within {LIMIT_S} s, found {seconds:.1f} s"
    assert growth < MAX_GROWTH_BYTES, f"expected less than 1 GB more, found {growth / 1e9:.1f}"


LENS = Lens(
    rockshape.Camera(**CAMERA, depth_scale=1.0),
    disparity=DisparityScale(ranges.BASELINE_M, step_px=ranges.DISPARITY_STEP_PX),
)
READERS = {
    "image": read_image,
    "labels": functools.partial(read_labels, shape=SHAPE, image_name="scene.png"),
    "range": functools.partial(read_points, shape=SHAPE, camera=LENS),
    "camera": functools.partial(read_lens, shape=SHAPE, image_name="scene.png"),
}


def readers(file: Seed, kind: RangeKind | None) -> None:
    """A damaged file is read or refused; kind is of range, where it is that."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"hostile{file.suffix}"
        path.write_bytes(file.data)
        with limited(file.kind):
            READERS[file.kind](path, **({"kind": kind} if file.kind == "range" else {}))


def pairs(file: Seed) -> None:
    """A damaged right picture of a stereo pair is matched or refused."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"hostile{file.suffix}"
        path.write_bytes(file.data)
        with limited("pair"):
            read_pair(path, left=image(), camera=LENS)


def folders(files: dict[str, bytes]) -> None:
    """A folder of masks with a damaged one is read or refused."""
    with tempfile.TemporaryDirectory() as folder:
        for name, data in files.items():
            (Path(folder) / name).write_bytes(data)
        with limited("folder"):
            READERS["labels"](folder)


def measuring(arguments: dict[str, object], method: str, descriptors: bool) -> None:
    """Any arrays are measured, without an unexplained number, or refused."""
    with limited("measure"):
        camera = arguments.pop("camera", None)
        if camera is not None:
            arguments["camera"] = rockshape.Camera(**camera)
        found = rockshape.measure(**arguments, method=method, descriptors=descriptors)
        table = found.to_frame()
        numbers = table.select_dtypes("number").to_numpy(np.float64, na_value=np.nan)
        assert not np.isinf(numbers).any()


FUZZERS = {
    "readers": (readers, (damaged_files(), RANGE_KINDS)),
    "pairs": (pairs, (damaged_files(kind="image"),)),
    "folders": (folders, (damaged_masks(),)),
    "measure": (measuring, (observations(), st.sampled_from(("paper", "robust")), st.booleans())),
}


def fresh(function: Callable[..., None]) -> Callable[..., None]:
    """Function of its own for Hypothesis to decorate."""

    @functools.wraps(function)
    def fresh(*args: object, **named: object) -> None:
        function(*args, **named)

    return fresh


def _total(outcome: str) -> int:
    return sum(number for (_, found), number in COUNTS.items() if found == outcome)


def told() -> str:
    """Number of inputs by what was tried and outcome."""
    kinds = sorted({what for what, _ in COUNTS})
    numbers = (
        f"{what} {COUNTS[what, 'taken']} taken {COUNTS[what, 'refused']} refused" for what in kinds
    )
    return f"{', '.join(numbers)}, {_total('late')} late"


def run(minutes: float, out: Path) -> int:
    """Fuzz for so long; the number of finds."""
    ends, finds, round_number = time.monotonic() + 60 * minutes, 0, 0
    out.mkdir(parents=True, exist_ok=True)
    first = int(time.time())
    warnings.simplefilter("ignore")
    while time.monotonic() < ends and finds < MAX_FINDS:
        for name, (function, drawn) in FUZZERS.items():
            round_number += 1
            options = settings(
                max_examples=EXAMPLES[name],
                deadline=None,
                derandomize=False,
                database=None,
                print_blob=True,
                suppress_health_check=list(HealthCheck),
                phases=(Phase.generate, Phase.shrink),
            )
            late = _total("late")
            try:
                seed(first + round_number)(options(given(*drawn)(fresh(function))))()
                text = f"{name}: late without a word" if _total("late") > late else ""
            except Exception as error:
                notes = "\n".join(getattr(error, "__notes__", ()))
                text = f"{name}: {type(error).__name__}: {error}\n{notes}\n"
            if text:
                finds += 1
                print(text[:2000], flush=True)
                (out / f"{name}-{first}-{round_number}.txt").write_text(text, encoding="utf-8")
        print(
            f"{time.strftime('%H:%M:%S')} round {round_number}: {told()}, {finds} finds", flush=True
        )
    return finds


def main() -> int:
    """Fuzz from the command line; 1 where there are finds."""
    parser = argparse.ArgumentParser(prog="python -m tests.hostile.fuzz")
    parser.add_argument("minutes", type=float)
    parser.add_argument("--out", type=Path, default=Path("reports/fuzz"))
    args = parser.parse_args()
    return int(run(args.minutes, args.out.resolve()) > 0)


if __name__ == "__main__":
    sys.exit(main())
