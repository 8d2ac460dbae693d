"""Progress within a scene: reports from the process that makes it to the one that shows it."""

import time
from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

T = TypeVar("T")
Report = Callable[[str], None]

_FIRST_S, _EVERY_S = 2.0, 1.0  # a scene that is done sooner than the first is not reported


class _Reporter:
    """Where this process reports to, and when it did so last."""

    report: Report | None = None
    due_s = 0.0


def report_progress_to(report: Report | None) -> None:
    """Send this process's reports to a function from now on, to none with None."""
    _Reporter.report = report
    _Reporter.due_s = time.monotonic() + _FIRST_S


def counted(items: Sequence[T], what: str) -> Iterator[T]:
    """Items in turn, reported as `12 of 500 rocks`; a single one is not."""
    for done, item in enumerate(items, 1):
        yield item
        if len(items) > 1 and _Reporter.report is not None and time.monotonic() >= _Reporter.due_s:
            _Reporter.due_s = time.monotonic() + _EVERY_S
            _Reporter.report(f"{done} of {len(items)} {what}")
