"""Run of a batch: images onto an executor, their tables into parts as each is done."""

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from pathlib import Path

from rockshape.batch.parts import ResultFolder

WINDOW = 64  # images handed over at a time: neither futures nor results pile up


@dataclass(frozen=True)
class ImageResult:
    """What became of one image: its table as Parquet, or why there is none."""

    rocks: int
    table: bytes | None
    failure: str = ""
    section: bytes | None = None  # of a page, where one was asked for


@dataclass(frozen=True)
class Task:
    """One image to be measured, and the key of its result."""

    key: str
    image: Path
    work: Callable[[], ImageResult]  # can be pickled


def run_batch(
    tasks: Sequence[Task],
    executor: Executor,
    parts: ResultFolder,
    on_done: Callable[[Task, ImageResult], None],
) -> dict[Path, str]:
    """Measure what the parts lack; return why images have no result."""
    failures: dict[Path, str] = {}
    for task, outcome in _outcomes([task for task in tasks if not parts.has(task.key)], executor):
        if outcome.table is None:
            failures[task.image] = outcome.failure
        else:
            parts.put(task.key, outcome.table, outcome.section)
        on_done(task, outcome)
    return failures


def _outcomes(tasks: Sequence[Task], executor: Executor) -> Iterator[tuple[Task, ImageResult]]:
    """Yield outcomes in the order of the tasks, so many ahead."""
    waiting: deque[tuple[Task, Future[ImageResult]]] = deque()
    coming = iter(tasks)
    try:
        while True:
            while len(waiting) < WINDOW and (task := next(coming, None)) is not None:
                waiting.append((task, executor.submit(task.work)))
            if not waiting:
                return
            task, future = waiting.popleft()
            yield task, future.result()
    finally:
        for _, future in waiting:
            future.cancel()
