"""Compactness of an outline: a measure in one file, with what it is held to."""

import numpy as np

from rockshape import Measure, Reason, RockView


def read(rock: RockView) -> float | Reason:
    """4π area over perimeter², 1 for a circle."""
    if not rock.resolved:
        return Reason.TOO_SMALL
    x, y = rock.smooth_outline_px.T
    next_x, next_y = np.roll(x, -1), np.roll(y, -1)
    area = abs(np.sum(x * next_y - next_x * y)) / 2
    perimeter = np.hypot(next_x - x, next_y - y).sum()
    return float(4 * np.pi * area / perimeter**2)


COMPACTNESS = Measure(
    column="compactness",
    title="compactness",
    min_points=3,
    evaluate=read,
    whole=True,
    expected_trait="roundness",
    view_truth="outline_roundness",
    value_range=(0.0, 1.0),
)
