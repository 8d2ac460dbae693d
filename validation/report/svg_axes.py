"""Axes of a chart: a range of values, straight or logarithmic, and the round values on it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

LOG_FROM = 20.0  # a measure whose values span more than this factor gets a logarithmic axis
WIDE = 300.0  # a logarithmic axis over more than this factor marks the decades alone


@dataclass(frozen=True)
class Axis:
    """Values from `low` to `high` on the way from `start` to `end`."""

    low: float
    high: float
    log: bool
    start: float  # place of low in the picture
    end: float  # place of high

    def places(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Picture's coordinates of values."""
        low, high, at = self.low, self.high, values
        if self.log:
            low, high, at = float(np.log10(low)), float(np.log10(high)), np.log10(values)
        return self.start + (self.end - self.start) * (at - low) / (high - low)

    def place(self, value: float) -> float:
        """Picture's coordinate of a value."""
        return float(self.places(np.array([value]))[0])

    def ticks(self) -> list[float]:
        """Round values inside the axis."""
        if self.log:
            lowest, highest = np.floor(np.log10(self.low)), np.ceil(np.log10(self.high))
            decades = 10.0 ** np.arange(lowest, highest + 1)
            steps = (1.0,) if self.high / self.low > WIDE else (1.0, 2.0, 5.0)
            values = [float(step * decade) for decade in decades for step in steps]
        else:
            step = 10.0 ** np.floor(np.log10((self.high - self.low) / 2.0))
            step *= next(m for m in (1.0, 2.0, 5.0) if (self.high - self.low) / (m * step) <= 6)
            first = np.ceil(self.low / step)
            values = list(np.arange(first, self.high / step + 1e-9) * step + 0.0)  # no −0
        return [value for value in values if self.low <= value <= self.high]


def axis_of(
    values: NDArray[np.float64], start: float, end: float, *, straight: bool = False
) -> Axis:
    """Axis that holds all the values, with a little room at both ends.

    It is logarithmic where values span a great factor, unless it is to be straight.
    """
    low, high = float(values.min()), float(values.max())
    if not straight and low > 0 and high / low > LOG_FROM:
        return Axis(low / 1.3, high * 1.3, True, start, end)
    pad = 0.06 * (high - low) or max(abs(high), 1.0) * 0.1
    return Axis(low - pad, high + pad, False, start, end)


def grid_rows(up: Axis, left: float, right: float) -> str:
    """Horizontal lines of a vertical axis, each with its value at the left."""
    return "".join(
        f'<path class="grid" d="M{left} {up.place(tick):.1f}H{right}"/>'
        f'<text x="{left - 6}" y="{up.place(tick) + 4:.1f}" class="end">{tick_text(tick)}</text>'
        for tick in up.ticks()
    )


def tick_text(value: float) -> str:
    """Mark's number, at most seven characters wide."""
    if value == 0 or 1e-3 <= abs(value) < 1e4:
        return f"{value:.3g}".replace("-", "−")
    digits, exponent = f"{value:.1e}".split("e")
    return f"{digits}e{int(exponent)}".replace("-", "−")
