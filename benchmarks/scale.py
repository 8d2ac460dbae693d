"""What a run costs: throughput with one worker and two, memory, disk, and what grows."""

import argparse
import os
import time
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import msgspec
import numpy as np
import pandas as pd

from validation.execution.dispatch import dispatch, run_packed
from validation.execution.executors import local
from validation.execution.run import prepare
from validation.execution.store import UnitStore, unit_key
from validation.execution.units import AnyUnit, units_of
from validation.scores.scoring import score_values
from validation.suite.suite import Suite, load_suite

COPIES = 250  # of the scenes measured, to see how scoring grows


def peak_mb() -> float:
    """Return the greatest resident set this process has had."""
    for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmHWM:"):
            return float(line.split()[1]) / 1024.0
    raise RuntimeError("/proc/self/status: expected VmHWM, found none")


def timed(work: Callable[[], object]) -> float:
    """Return how many seconds some work takes."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def yard_of(scenes: int) -> Suite:
    """Return the yard of suite `ci` with so many scenes, its renderer settled."""
    suite = load_suite("ci")
    yard = msgspec.structs.replace(suite.experiments[0], scenes=scenes, pictured=0)
    return prepare(msgspec.structs.replace(suite, experiments=(yard,)))


def throughput(keyed: list[tuple[str, AnyUnit]], folder: Path, *, jobs: int) -> UnitStore:
    """Run units with so many workers, already warm; print the scenes an hour, time and peak."""
    store = UnitStore(folder, keep=False)
    with local(jobs) as executor:
        for future in [executor.submit(run_packed, keyed[0][1]) for _ in range(jobs)]:
            future.result()
        before = [call.result() for call in [executor.submit(_state) for _ in range(jobs)]]
        seconds = timed(lambda: dispatch(keyed, executor, store, lambda _: None))
        after = [call.result() for call in [executor.submit(_state) for _ in range(jobs)]]
        idle = timed(lambda: [f.result() for f in [executor.submit(len, b"") for _ in range(500)]])
    cpu = sum(state[0] for state in after) - sum(state[0] for state in before)
    shown = ", ".join(f"{state[1]:.0f}" for state in after)
    print(
        f"{jobs} worker(s): {len(keyed)} scenes in {seconds:.1f} s, "
        f"{3600 * len(keyed) / seconds:.0f} scenes an hour; processor time a scene "
        f"{cpu / len(keyed):.2f} s; peak of each {shown} MB; "
        f"{idle / 500 * 1e3:.2f} ms for an empty call",
        flush=True,
    )
    return store


def _state() -> tuple[float, float]:
    """Return a worker's processor time in seconds and its peak in MB."""
    time.sleep(0.5)  # so that the other worker takes the other call
    return time.process_time(), peak_mb()


def growth(suite: Suite, keyed: list[tuple[str, AnyUnit]], store: UnitStore) -> None:
    """Print what storing, reading and scoring cost, and how large a table of records is."""
    keys = [key for key, _ in keyed]
    sizes = [store.path(key).stat().st_size for key in keys]
    packed = store.path(keys[0]).read_bytes()
    put = timed(lambda: [store.put(f"00{i:04d}", packed) for i in range(200)]) / 200
    get = timed(lambda: [store.get(f"00{i:04d}") for i in range(200)]) / 200
    print(
        f"a unit's file: {np.mean(sizes) / 1e3:.0f} kB, written in {put * 1e3:.1f} ms, "
        f"read in {get * 1e3:.1f} ms"
    )
    records = pd.concat([store.get(key).records for key in keys], ignore_index=True)
    for copies in (COPIES // 5, COPIES):
        many = pd.concat(
            [records.assign(scene=records["scene"] + copy * len(keys)) for copy in range(copies)],
            ignore_index=True,
        )
        scenes = copies * len(keys)
        size = many.memory_usage(deep=True).sum()
        seconds = timed(lambda: score_values(suite, many))  # noqa: B023 (called at once)
        print(
            f"{scenes} scenes, {len(many)} records: {size / 1e6:.0f} MB, "
            f"{size / scenes / 1e3:.1f} kB a scene; all scores without intervals {seconds:.1f} s; "
            f"this process's peak {peak_mb():.0f} MB",
            flush=True,
        )


def main() -> None:
    """Print the figures that docs/scale.md quotes."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=12)
    args = parser.parse_args()
    suite = yard_of(args.scenes)
    keyed = [(unit_key(unit), unit) for unit in units_of(suite)]
    print(f"{os.cpu_count()} processors; {args.scenes} scenes of 6 rocks in 4 views")
    with TemporaryDirectory() as folder:
        for jobs in (1, 2):
            store = throughput(keyed, Path(folder) / str(jobs), jobs=jobs)
        growth(suite, keyed, store)


if __name__ == "__main__":
    main()
