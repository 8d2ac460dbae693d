"""Fuzzers of every reader and of `rockshape.measure`: `python -m tests.hostile.fuzz MINUTES`.

Hypothesis draws the damage and shrinks what it finds. A reader may return or raise InputError; so
may `measure`. Anything else, more than 10 s or 1 GB among it, is a find: it is printed and written
to reports/fuzz, from where it becomes a test.
"""

import argparse
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
from hypothesis.extra import numpy as arrays

import rockshape
from rockshape.errors import InputError
from rockshape.io import read_camera, read_image, read_labels, read_range
from tests.hostile.judge import LIMIT_S, MAX_GROWTH_BYTES, peak_bytes
from tests.hostile.mutations import LENGTHS, MUTATIONS, retyped_json
from tests.hostile.seeds import CAMERA, SHAPE, readable_formats, seeds_of

MAX_FINDS = 50
COUNTS: Counter[str] = Counter()


@contextmanager
def limited() -> Iterator[None]:
    """Fail where what is done takes longer or more memory than may be; InputError is allowed."""

    def late(*_: object) -> None:
        raise AssertionError(f"expected an end within {LIMIT_S} s, found none")

    before = peak_bytes(reset=True)
    signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, LIMIT_S)
    try:
        yield
        COUNTS["taken"] += 1
    except InputError as error:
        COUNTS["refused"] += 1
        assert str(error).strip()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
    assert peak_bytes() - before < MAX_GROWTH_BYTES


@st.composite
def damaged_files(draw: st.DrawFn) -> tuple[str, str, bytes]:
    """Kind, suffix and content of a damaged file of any readable format."""
    one = draw(st.sampled_from(readable_formats()))
    seed_file = draw(st.sampled_from(seeds_of(one)))
    data = seed_file.data
    if draw(st.booleans()) and data.startswith(b"{"):
        data = retyped_json(data, np.random.default_rng(draw(st.integers(0, 2**32))))
    for _ in range(draw(st.integers(0, 3))):
        way = draw(st.sampled_from(("any", "bytes", "length", "cut")))
        at = draw(st.integers(0, max(0, len(data) - 1)))
        if way == "any":
            mutation = draw(st.sampled_from(MUTATIONS))
            data = mutation(data, np.random.default_rng(draw(st.integers(0, 2**32))))
        elif way == "bytes":
            patch = draw(st.binary(min_size=1, max_size=8))
            data = data[:at] + patch + data[at + len(patch) :]
        elif way == "length":
            order = draw(st.sampled_from(("little", "big")))
            field = draw(st.sampled_from(LENGTHS)).to_bytes(4, order)
            data = data[:at] + field + data[at + 4 :]
        else:
            data = data[:at]
    return one.kind, draw(st.sampled_from(one.suffixes)), data


def read_file(kind: str, path: Path) -> None:
    """Read a file as what it is for."""
    camera = rockshape.Camera(**CAMERA, depth_scale=1.0)
    if kind == "image":
        read_image(path)
    elif kind == "labels":
        read_labels(path, shape=SHAPE)
    elif kind == "range":
        read_range(path, shape=SHAPE, camera=camera)
    else:
        read_camera(path, shape=SHAPE)


def readers(file: tuple[str, str, bytes]) -> None:
    """A damaged file is read or refused."""
    kind, suffix, data = file
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"hostile{suffix}"
        path.write_bytes(data)
        with limited():
            read_file(kind, path)


_ODD = st.sampled_from((0.0, -0.0, 1.0, 0.5, -1.0, np.nan, np.inf, -np.inf, 1e-38, 3e38, 1e-6))
_SIDES = st.tuples(st.integers(0, 24), st.integers(0, 24))


@st.composite
def observations(draw: st.DrawFn) -> dict[str, object]:
    """Arguments of `rockshape.measure`: pictures, labels, range and cameras of any values."""
    shape = draw(_SIDES)
    kind = draw(st.sampled_from(("u1", "u2", "f4", "f8", "i4", "?")))
    given_image = draw(
        arrays.arrays(kind, draw(st.sampled_from((shape, (*shape, 3), (*shape, 4)))))
        if kind not in ("f4", "f8")
        else arrays.arrays(kind, shape, elements=_ODD.map(np.dtype(kind).type))
    )
    found: dict[str, object] = {"image": given_image}
    if draw(st.booleans()):
        own = draw(arrays.arrays("i4", shape, elements=st.integers(-1, 3), fill=st.just(0)))
        found["labels"] = own
    if draw(st.booleans()):
        places = draw(st.sampled_from((shape, (*shape, 3))))
        base = np.full(places, draw(st.sampled_from((0.5, 2.0, 1e3))))
        spoilt = draw(arrays.arrays("f8", places, elements=_ODD, fill=st.just(0.0)))
        found["range_m"] = np.where(spoilt == 0, base, spoilt)
    if draw(st.booleans()):
        size = {"width": shape[1], "height": shape[0]}
        focal = draw(st.sampled_from((1e-9, 1.0, 80.0, 1e9)))
        found["camera"] = {"fx": focal, "fy": focal, "cx": 1.0, "cy": 1.0, **size}
    return found


def measuring(arguments: dict[str, object], method: str, descriptors: bool) -> None:
    """Any arrays are measured, without an unexplained number, or refused."""
    with limited():
        camera = arguments.pop("camera", None)
        if camera is not None:
            arguments["camera"] = rockshape.Camera(**camera)
        found = rockshape.measure(**arguments, method=method, descriptors=descriptors)
        table = found.to_frame()
        numbers = table.select_dtypes("number").to_numpy(np.float64, na_value=np.nan)
        assert not np.isinf(numbers).any()


FUZZERS = {
    "readers": (readers, (damaged_files(),)),
    "measure": (measuring, (observations(), st.sampled_from(("paper", "robust")), st.booleans())),
}


def fresh(function: Callable[..., None]) -> Callable[..., None]:
    """Function of its own for Hypothesis to decorate."""

    @functools.wraps(function)
    def fresh(*args: object, **named: object) -> None:
        function(*args, **named)

    return fresh


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
                max_examples=300,
                deadline=None,
                derandomize=False,
                database=None,
                print_blob=True,
                suppress_health_check=list(HealthCheck),
                phases=(Phase.generate, Phase.shrink),
            )
            try:
                seed(first + round_number)(options(given(*drawn)(fresh(function))))()
            except Exception as error:
                finds += 1
                notes = "\n".join(getattr(error, "__notes__", ()))
                text = f"{name}: {type(error).__name__}: {error}\n{notes}\n"
                print(text[:2000], flush=True)
                (out / f"{name}-{first}-{round_number}.txt").write_text(text, encoding="utf-8")
        told = ", ".join(f"{number} {what}" for what, number in sorted(COUNTS.items()))
        print(
            f"{time.strftime('%H:%M:%S')} round {round_number}: {told}, {finds} finds", flush=True
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
