"""Roundness: Wadell's, how worn the corners of the outline are.

Meaning: the field's standard of a grain's wear: small where corners are sharp, 1 where none is
sharper than the largest circle inside.

Formula: Wadell's (1/n) sum r_i / R, the mean radius of the n corners over that of the largest
inscribed circle, read at one scale: the outline is smoothed by 0.12 of the radius of the disc of
equal area. r is that of the root mean square curvature over all outward turning, sqrt(integral of k
ds / integral of k³ ds), and a curve fitted to clean outlines of exact roundness undoes what the
smoothing did to r / R; see `rockshape/outline/roundness.py`. Only `robust`: the paper has no such
measure, and what it calls roundness rises with angularity.

Range and unit: 0 to 1, a pure number.

Blind to: dents, corners' number, and ripples shorter than half the radius of the disc of equal
area, which are texture. On the exact scale for rocks of seven to eleven corners; with fewer corners
it reads sharper, a square of 0.2 as 0.05 and a box of 0.4 as 0.28, and ellipses by up to 0.2
rounder.

Smallest size: 30 px. The scale is the same share of any rock from 30 px on, so that rough
silhouettes have the same mean within 0.03 from 60 to 400 px; below 30 px it is 1.8 px, and more of
the corners is lost. docs/resolution.md has correlation with the truth, bias and error by size
(`python benchmarks/run.py roundness`). The gate is the rock's width, for corners lie across it
however long the rock is.

Degenerate: 1 where nothing bends more than the inscribed circle. Contacts, edges that neighbours or
ignored regions have made, are no corners, and are left out with two deviations of the smoothing on
either side; with less than half of the outline left it refuses. It refuses rocks that the frame
cuts or less than 10 px wide.

Source: Wadell (1932), Volume, shape, and roundness of rock particles.
"""

from typing import TYPE_CHECKING

from rockshape.measures.measure import Measure
from rockshape.measures.reading import Reason
from rockshape.outline.inscribed_circle import inscribed_circle
from rockshape.outline.roundness import wadell_roundness
from rockshape.rock.view import MIN_OUTLINE_SHARE, RockView

if TYPE_CHECKING:
    from matplotlib.figure import Figure


MIN_WIDTH_PX = 10.0  # least Feret diameter
MIN_POINTS = 30


def _read_robust(rock: RockView) -> float | Reason:
    if not rock.feret_px[0] >= MIN_WIDTH_PX:
        return Reason.TOO_SMALL
    if rock.form is None:
        return Reason.DEGENERATE
    if rock.outline_share < MIN_OUTLINE_SHARE:
        return Reason.CONTACTS
    return wadell_roundness(rock.form, rock.is_own(rock.form.points))


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
