"""Time of a frame from range to table: whole, by package, and as it grows."""

import signal
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from types import FrameType

import numpy as np
from case import Case, Column, Table
from made_frame import make_frame
from timing import best_of
from views import made_views

import rockshape
from rockshape import pipeline
from rockshape.measurement import to_frame
from rockshape.observation import Observation
from synth.spec import convert_spec

METHODS = ("paper", "robust")
SAMPLE_S = 0.002
SERIES = (Column("method"), Column("frame, px"), Column("rocks found", "", "d"))


def whole_frame(*, preset: str = "mer-navcam", rocks: int = 40, rounds: int = 4) -> list[Table]:
    """Time both methods on a rendered frame, then sample where the time goes."""
    table = {
        "seed": 10_005,
        "rocks": {"count": rocks},
        "camera": {"preset": preset},
        "views": {"count": 1},
    }
    observation = next(made_views(convert_spec(table, where="frame"))).observation

    def work(method: str) -> None:
        to_frame(pipeline.measure(observation, method=method))

    times = best_of(rounds, {method: lambda m=method: work(m) for method in METHODS})
    found = [len(pipeline.measure(observation, method=method).rocks) for method in METHODS]
    shape = "×".join(str(side) for side in observation.image.shape)
    rows = [
        (method, shape, count, times[method].cpu_s, times[method].wall_s)
        for method, count in zip(METHODS, found, strict=True)
    ]
    shares = {method: _sampled(lambda m=method: work(m), rounds) for method in METHODS}
    names = sorted(shares["paper"] | shares["robust"], key=lambda n: -shares["paper"][n])
    return [
        Table((*SERIES, Column("processor", "s"), Column("wall", "s")), rows),
        Table(
            (Column("package"), *(Column(method, "%", ".0f") for method in METHODS)),
            [(name, *(100 * shares[method][name] for method in METHODS)) for name in names],
            name="packages",
        ),
    ]


def _sampled(work: Callable[[], object], rounds: int) -> Counter[str]:
    """Return the share of processor time whose innermost own frame lies in each package."""
    root = str(Path(rockshape.__file__).parent)
    hits: Counter[str] = Counter()

    def sample(_: int, frame: FrameType | None) -> None:
        while frame is not None and not frame.f_code.co_filename.startswith(root):
            frame = frame.f_back
        if frame is not None:
            parts = Path(frame.f_code.co_filename).relative_to(root).parts
            hits["/".join(parts[:-1]) or "the pipeline itself"] += 1

    before = signal.signal(signal.SIGPROF, sample)
    signal.setitimer(signal.ITIMER_PROF, SAMPLE_S, SAMPLE_S)
    try:
        for _ in range(rounds):
            work()
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)
    packages: Counter[str] = Counter()
    for name, count in hits.items():
        packages[name.partition("/")[0]] += count
    total = packages.total()
    return Counter({name: count / total for name, count in packages.items()})


def growth(
    *,
    sides: tuple[int, ...] = (512, 1024, 2048, 4096),
    many: int = 64,
    rocks: tuple[int, ...] = (10, 32, 100, 316, 1000),
    side: int = 4096,
) -> list[Table]:
    """Time frames of growing size, then a large frame with ever more rocks of 40 px."""
    _seconds(side_px=256, rocks=4, radius_px=None, method="paper")  # warms up
    columns = (*SERIES, Column("processor", "s"))
    pixels, crowds = [], []
    powers = []
    for method in METHODS:
        mine = [s for s in sides if method == "paper" or s <= 2048]
        series = [
            (s, *_seconds(side_px=s, rocks=many, radius_px=None, method=method)) for s in mine
        ]
        pixels += [(method, f"{s}²", found, spent) for s, spent, found in series]
        powers.append(
            (
                method,
                f"pixels, {many} rocks that grow along",
                _power([(s**2, t) for s, t, _ in series]),
            )
        )
    bare, _ = _seconds(side_px=side, rocks=1, radius_px=20.0, method="paper")
    for count in rocks:
        spent, found = _seconds(side_px=side, rocks=count, radius_px=20.0, method="paper")
        crowds.append(("paper", f"{side}²", found, spent))
    added = [(found, spent - bare) for _, _, found, spent in crowds if spent > 1.05 * bare]
    powers.append(("paper", "rocks of 40 px, over a frame with one", _power(added)))
    return [
        Table((Column("method"), Column("grows"), Column("exponent", "", ".2f")), powers),
        Table(columns, pixels, name="pixels"),
        Table(columns, crowds, name="rocks"),
    ]


def _seconds(
    *, side_px: int, rocks: int, radius_px: float | None, method: str
) -> tuple[float, int]:
    """Return the processor time of a made frame, the better of two, and the rocks found."""
    frame = make_frame(side_px=side_px, rocks=rocks, radius_px=radius_px)
    observation = Observation(image=frame.image, points_m=frame.points_m, camera=frame.camera)
    found: list[int] = []

    def work() -> None:
        found.append(len(pipeline.measure(observation, method=method).rocks))

    return best_of(1, {"": work})[""].cpu_s, found[-1]


def _power(pairs: list[tuple[float, float]]) -> float:
    """Return the power p of the best line through log(time) over log(size)."""
    if len(pairs) < 2:
        return float("nan")
    return float(np.polyfit(*np.log(np.transpose(pairs)), 1)[0])


FRAME_CASE = Case(
    name="frame",
    what="a rendered frame, found, measured and tabled; and its processor time by package",
    run=whole_frame,
    smallest={"preset": "imp", "rocks": 3, "rounds": 1},
)

GROWTH_CASE = Case(
    name="growth",
    what="processor time of drawn frames by pixels and by rocks; an exponent of 1 is linear",
    run=growth,
    smallest={"sides": (128, 256), "many": 9, "rocks": (2, 4), "side": 256},
)
