"""Axis ratio: the paper's "eccentricity", of an ellipse that stands for the outline.

Meaning: how long the rock's outline is for its width: 1 for a circle, 0.5 for an ellipse twice as
long as wide. Form only; the corners hardly move it.

Formula: b/a. `paper`: of the ellipse fitted to the boundary pixels by direct least squares
(equations 3 to 5). `robust`: of the ellipse with the second moments of the area within the
sub-pixel edge; of a rock cut by the frame, of the hyper-accurate fit to the part of the edge that
does not lie on the frame's border.

Range and unit: 0 to 1, a pure number. Not the eccentricity sqrt(1 - b²/a²) of geometry.

Blind to: which way the rock lies, and all of the outline but its length and width: a square has
the axis ratio 1.

Smallest size: `paper`: boundary pixels lie half a pixel inside, so that thin rocks come out too
thin, by 2.5 % at 30 px, 1.1 % at 100 px and 0.2 % at 500 px. `robust`: true within 0.2 % in the
mean from 30 px on; the outline must be 4 px wide.

Degenerate: NaN for points on a line, and for an arc whose best conic is no ellipse, which is
`truncated`. A third of an ellipse 0.60 on pixels gives 0.601 ± 0.020 at a half-axis of 50 px and
0.599 ± 0.006 at 100 px; a quarter 0.603 ± 0.016 at 100 px.

Source: Fox et al. (2002), section 2, Ellipse Fitting; Halíř and Flusser (1998); Kanatani, Sugaya
and Kanazawa (2016).
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from rockshape.ellipse.direct import MIN_POINTS, Ellipse
from rockshape.measures.measure import Measure
from rockshape.measures.reading import Reason
from rockshape.rock.view import RockView

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def axis_ratio(ellipse: Ellipse) -> float:
    """Minor over major axis of an ellipse, b/a; 1 for a circle.

    Not the eccentricity sqrt(1 - b²/a²) of geometry, though the paper calls it so.
    Source: Fox et al. (2002), section 2, Ellipse Fitting.
    """
    return ellipse.axis_ratio


def _read_robust(rock: RockView) -> float | Reason:
    if not rock.resolved:
        return Reason.TOO_SMALL
    if rock.form_ellipse is None:
        return Reason.TRUNCATED if rock.truncated else Reason.DEGENERATE
    return axis_ratio(rock.form_ellipse)


def _evaluate(rock: RockView) -> float:
    return float("nan") if rock.ellipse is None else axis_ratio(rock.ellipse)


def _draw() -> "Figure":
    """Ellipse of three outlines, and its half-axes."""
    from rockshape.measures import drawing  # noqa: PLC0415 - brings Matplotlib

    figure, row = drawing.panels(3)
    for panel, sample in zip(row, drawing.BY_FORM, strict=True):
        outline = sample.traced_px()
        ellipse = drawing.fitted(outline)
        drawing.draw_rock(panel, outline)
        drawing.draw_ellipse(panel, ellipse)
        ring = ellipse.ring(4)
        centre = ring.mean(axis=0)
        for name, end, aside, colour in (
            ("a", ring[0], (3.0, 11.0), drawing.FIRST),
            ("b", ring[1], (11.0, 3.0), drawing.SECOND),
        ):
            panel.plot(*np.array([centre, end]).T, color=colour, linewidth=1.6)
            x, y = (centre + end) / 2 + aside
            panel.text(x, y, name, color=colour, weight="bold", ha="center", va="center")
        panel.set_title(f"b/a = {ellipse.axis_ratio:.2f}", fontsize=9)
    return figure


PAPER = Measure(
    column="axis_ratio",
    title="axis ratio",
    paper_name="eccentricity",
    min_points=MIN_POINTS,
    evaluate=_evaluate,
    expected_trait="form",
    view_truth="outline_axis_ratio",
    equals="outline_axis_ratio",
    value_range=(0.0, 1.0),
    figure=_draw,
)
ROBUST = replace(PAPER, evaluate=_read_robust)
