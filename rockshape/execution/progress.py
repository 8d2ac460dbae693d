"""Progress of a run: a bar on a terminal, one plain line for each thing done elsewhere."""

import sys
from typing import NoReturn

from tqdm import tqdm


class Progress:
    """Progress on standard error."""

    def __init__(self, total: int, done: int, *, unit: str) -> None:
        """Begin with so many units done of a total."""
        self._bar: tqdm[NoReturn] = tqdm(
            total=total, initial=done, unit=unit, disable=None, file=sys.stderr
        )
        self._total = total
        self._done = done
        if done and self._bar.disable:
            print(f"{done} of {total} {unit}s are there already", file=sys.stderr, flush=True)

    def advance(self, what: str) -> None:
        """Count one as done."""
        self._done += 1
        if self._bar.disable:
            print(f"[{self._done}/{self._total}] {what}", file=sys.stderr, flush=True)
            return
        self._bar.set_description(what)
        self._bar.update()

    def close(self) -> None:
        """Leave the terminal tidy."""
        self._bar.close()
