"""Progress of a dataset's generation: scenes written, and how far the unfinished ones are."""

import sys
import threading
import time
from multiprocessing import get_context
from typing import NoReturn

from tqdm import tqdm

_LINE_EVERY_S = 10.0  # of a scene under way, where there is no terminal


class ProgressBar:
    """Progress: a bar on a terminal, elsewhere a line a scene, and one now and then within it.

    `reports` takes texts from worker processes; None where nothing is shown.
    """

    def __init__(self, scenes: int, missing: int, *, show: bool) -> None:
        self._lines = show and not sys.stderr.isatty()
        self._scenes, self._there, self.advanced = scenes, scenes - missing, 0
        self._bar: tqdm[NoReturn] = tqdm(
            total=scenes,
            initial=self._there,
            desc="scenes",
            unit="scene",
            disable=not show or self._lines,
        )
        self._last_s = time.monotonic()
        self.reports = get_context("spawn").SimpleQueue() if show else None
        self._reader = threading.Thread(target=self._read, daemon=True)
        if show:
            self._reader.start()

    def advance(self, name: str) -> None:
        """Count one scene as written."""
        self.advanced += 1
        self._bar.update()
        if self._lines:
            done = self._there + self.advanced
            print(f"scene {name} written ({done} of {self._scenes})", file=sys.stderr)

    def close(self) -> None:
        """Leave the terminal tidy."""
        if self.reports is not None:
            self.reports.put(None)
            self._reader.join(timeout=1.0)
        self._bar.close()

    def _read(self) -> None:
        """Show reports until there is a None."""
        while self.reports is not None:
            text = self.reports.get()
            if text is None:
                return
            if not self._lines:
                self._bar.set_postfix_str(text)
            elif time.monotonic() >= self._last_s + _LINE_EVERY_S:
                self._last_s = time.monotonic()
                print(text, file=sys.stderr)
