"""Roundness: Wadell's, how worn the corners of the outline are.

Meaning: the field's standard of a grain's wear: small where corners are sharp, 1 where none is
sharper than the largest circle inside. Independent of form for boxes and polygons.

Formula: (1/n) sum r_i / R: the mean radius of curvature of the n corners over the radius of the
largest inscribed circle, a corner being where the radius is less than R. The curvature is smoothed
by a Gaussian and each corner's radius is solved from its peak and its turning; see
`rockshape/outline/roundness.py`. Only `robust`: the paper has no such measure, and what it calls
roundness rises with angularity.

Range and unit: 0 to 1, a pure number.

Blind to: how many corners there are, dents, and corners that turn by less than 11 degrees.

Smallest size: 60 px for a rock of few corners. Corners that are many are small, and read too
round: a rock of some eleven corners wants 200 px. docs/resolution.md has the correlation with the
truth, bias and error by size, beside fast_rs's (`python benchmarks/run.py roundness`). The gate is
the rock's width, for corners lie across it however long the rock is.

Degenerate: 1 where there is no corner. Refuses rocks that the frame cuts or less than 12 px wide.

Source: Wadell (1932), Volume, shape, and roundness of rock particles.
"""

from typing import TYPE_CHECKING

from rockshape.measures.measure import Measure
from rockshape.measures.reading import Reason
from rockshape.outline.roundness import MIN_POINTS, inscribed_circle, wadell_roundness
from rockshape.rock.view import RockView

if TYPE_CHECKING:
    from matplotlib.figure import Figure


MIN_WIDTH_PX = 12.0  # least Feret diameter


def _read_robust(rock: RockView) -> float | Reason:
    if not rock.feret_px[0] >= MIN_WIDTH_PX:
        return Reason.TOO_SMALL
    return wadell_roundness(rock.smooth_outline_px)


def _draw() -> "Figure":
    """Largest inscribed circle and the circles of the corners."""
    from matplotlib.patches import Circle, Polygon  # noqa: PLC0415 - half a second

    from rockshape.measures import drawing  # noqa: PLC0415

    figure, row = drawing.panels(3)
    for panel, sample in zip(row, drawing.BY_ROUNDNESS[:3], strict=True):
        outline = sample.outline_px()
        panel.add_patch(
            Polygon(outline, facecolor=drawing.ROCK, edgecolor=drawing.INK, linewidth=1.2)
        )
        largest = (*inscribed_circle(outline), drawing.FIRST)
        corners = [
            (corner, sample.radius_px, drawing.SECOND)
            for corner in zip(sample.x_px, sample.y_px, strict=True)
        ]
        for centre, radius, colour in (*corners, largest):
            circle = Circle(centre, radius, fill=False, edgecolor=colour, linewidth=1.4)
            panel.add_patch(circle)
        panel.set_title(f"mean r / R = {sample.roundness:.2f}", fontsize=9)
        drawing.close_margins(panel)
    return figure


ROBUST = Measure(
    column="roundness",
    title="roundness",
    min_points=MIN_POINTS,
    evaluate=_read_robust,
    whole=True,
    expected_trait="roundness",
    view_truth="outline_roundness",
    equals="outline_roundness",
    value_range=(0.0, 1.0),
    figure=_draw,
)
