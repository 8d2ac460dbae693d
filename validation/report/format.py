"""Numbers as text, the same in every file of a run."""

import math


def number(value: float) -> str:
    """Number for reading: three decimals below 100, none above, a dash for NaN."""
    if not math.isfinite(value):
        return "–"
    if value == 0 or 1e-3 <= abs(value) < 100:
        text = f"{value:.3f}"
    elif abs(value) < 1e-3:
        text = f"{value:.1e}"
    else:
        text = f"{value:.0f}"
    return text.replace("-", "−")


def interval(low: float, high: float) -> str:
    """Interval for reading, empty where there is none."""
    if not (math.isfinite(low) and math.isfinite(high)):
        return ""
    return f"{number(low)} … {number(high)}"
