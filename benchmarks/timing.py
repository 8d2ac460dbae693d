"""Processor time, wall time and memory of functions and of child processes."""

import multiprocessing
import os
import resource
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from case import Column

TIME_COLUMNS = (Column("processor", "ms"), Column("wall", "ms"), Column("ratio", "", ".2f"))


@dataclass(frozen=True)
class Timing:
    """Seconds of one call, or the least of several."""

    cpu_s: float
    wall_s: float

    def least(self, other: "Timing") -> "Timing":
        """Return the smaller of each."""
        return Timing(min(self.cpu_s, other.cpu_s), min(self.wall_s, other.wall_s))

    def cells(self, floor: "Timing") -> tuple[float, float, float]:
        """Return the cells of TIME_COLUMNS: milliseconds, and processor time over the floor's."""
        return 1e3 * self.cpu_s, 1e3 * self.wall_s, self.cpu_s / floor.cpu_s


NEVER = Timing(float("inf"), float("inf"))


def timed(call: Callable[[], object]) -> Timing:
    """Return the time of one call."""
    wall, cpu = time.perf_counter(), time.process_time()
    call()
    return Timing(time.process_time() - cpu, time.perf_counter() - wall)


def timed_with_children(call: Callable[[], object]) -> Timing:
    """Return the time of one call, that of processes which end within it included."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    own = timed(call)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    children_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Timing(own.cpu_s + children_s, own.wall_s)


def best_of(rounds: int, works: Mapping[str, Callable[[], object]]) -> dict[str, Timing]:
    """Return the least time of each work, taken in turns after one round to warm up."""
    best = dict.fromkeys(works, NEVER)
    for turn in range(rounds + 1):
        for name, work in works.items():
            found = timed(work)
            if turn:
                best[name] = best[name].least(found)
    return best


def timed_command(command: Sequence[str], **options: Any) -> Timing:
    """Return the time of one process from start to end, its children included."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, check=True, **options)
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return Timing(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall)


def in_fresh_process(call: Callable[..., Any], *args: Any) -> Any:
    """Return what a module's function returns in a process of its own."""
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(max_workers=1, mp_context=context) as pool:
        return pool.submit(call, *args).result()


def memory_mb(*, peak: bool = False) -> float:
    """Return this process's resident set, now or at its peak."""
    if peak:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20
