"""Many tiles in turn, made by one process or by several."""

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future
from typing import TypeVar

from synth.bed.bed import Bed
from synth.bed.make import make_tile
from synth.dataset.workers import worker_pool
from synth.spec.bed import BedSpec

T = TypeVar("T")

_AHEAD = 4  # tiles that each process may be ahead of the reader


def tiles(spec: BedSpec, *, start: int = 0, jobs: int = 1) -> Iterator[Bed]:
    """Tiles from number `start` on, as many as the spec has, in rising order."""
    return in_order(make_tile, spec, range(start, start + spec.tiles), jobs=jobs)


def in_order(
    work: Callable[[BedSpec, int], T], spec: BedSpec, indices: Sequence[int], *, jobs: int
) -> Iterator[T]:
    """What `work` makes of each index, in their order, by so many processes."""
    if jobs == 1 or len(indices) < 2:
        yield from (work(spec, index) for index in indices)
        return
    waiting: deque[Future[T]] = deque()
    with worker_pool(min(jobs, len(indices))) as pool:
        try:
            for index in indices:
                waiting.append(pool.submit(work, spec, index))
                if len(waiting) >= _AHEAD * jobs:
                    yield waiting.popleft().result()
            while waiting:
                yield waiting.popleft().result()
        finally:
            for future in waiting:
                future.cancel()
