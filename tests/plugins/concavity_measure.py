"""A measure from outside in one file, with all that it is held to."""

from typing import TYPE_CHECKING

from rockshape import Measure, Reason, RockView
from rockshape.outline.descriptors import convexity, perimeter

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _read(rock: RockView) -> float | Reason:
    if not rock.resolved:
        return Reason.TOO_SMALL
    outline = rock.smooth_outline_px
    return 1 - convexity(outline, perimeter(outline))


def _draw() -> "Figure":
    from matplotlib.figure import Figure

    return Figure()


CONCAVITY = Measure(
    column="concavity",
    title="concavity",
    min_points=3,
    evaluate=_read,
    evaluate_batch=lambda rocks: [_read(rock) for rock in rocks],
    whole=True,
    expected_trait="angularity",
    view_truth="outline_angularity",
    value_range=(0.0, 1.0),
    figure=_draw,
)
