"""Processor time of warm runs."""

import time
from collections.abc import Callable
from typing import TypeVar

import numpy as np

T = TypeVar("T")


def timed(call: Callable[[], T], repeats: int) -> tuple[float, T]:
    """Median processor seconds of some runs after a first one, and the result."""
    result = call()
    seconds = []
    for _ in range(repeats):
        begun = time.process_time()
        result = call()
        seconds.append(time.process_time() - begun)
    return float(np.median(seconds)), result
