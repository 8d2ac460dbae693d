"""Ellipse error: how far the outline lies from its ellipse.

Meaning: what keeps the outline from being an ellipse, corners above all: it rises with angularity,
and with dents and bulges of any kind.

Formula: `paper`: the mean of squared distances along the ray from the ellipse's centre. The text
says sum, the published values say mean: pixels alone sum to 4 to 39 px², where table 4 has 0.30.
`robust`: RMS/sqrt(ab), the root of the mean squared orthogonal distance of the outline's form from
the ellipse fitted to that form, over the root of the half-axes' product. The form is 100 points
evenly along the sub-pixel edge, smoothed by 0.12 of the radius of the disc of equal area.

Range and unit: from 0. `paper` in px², growing with the square of the rock's size in pixels;
`robust` a pure number, 0.02 for a pebble, 0.04 for a sharp polygon of seven corners, 0.11 for a
square.

Blind to: the axis ratio, as far as the ellipse follows it; `robust` to ripples shorter than
half the radius of the disc of equal area.

Smallest size: `paper`: pixels alone give about 0.07 px². `robust` holds from 60 px
on; docs/resolution.md has its order and level by size, docs/findings.md why its scale is what it
is.

Degenerate: NaN where the outline has no ellipse; `robust` refuses rocks that the frame cuts or
less than 4 px wide.

Source: Fox et al. (2002), section 2, Ellipse Fitting, and figure 2.
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipse.direct import MIN_POINTS, Ellipse, fit_ellipse
from rockshape.measures.measure import Measure
from rockshape.measures.reading import Reason
from rockshape.rock.view import RockView

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def ellipse_error_px2(
    ellipse: Ellipse, outline_px: NDArray[np.float64], *, total: bool = False
) -> float:
    """Mean squared radial distance of the outline, (n, 2), from its ellipse, in px².

    The text says sum, the published values say mean: pixel quantisation alone sums to 4 to 39 px²,
    where table 4 has 0.30. `total` gives the sum. Pixels alone give a mean near 0.07 px²; for one
    form the error grows with the square of its size in pixels. NaN for an empty outline.
    Source: Fox et al. (2002), section 2, Ellipse Fitting, and figure 2.
    """
    if len(outline_px) == 0:
        return float("nan")
    squares = ellipse.radial_distance(outline_px) ** 2
    return float(squares.sum() if total else squares.mean())


def ellipse_error(ellipse: Ellipse, outline: NDArray[np.float64]) -> float:
    """RMS orthogonal distance of the outline, (n, 2), from its ellipse over sqrt(ab).

    A pure number, free of the outline's unit and scale. NaN for an empty outline.
    """
    if len(outline) == 0:
        return float("nan")
    squares = ellipse.orthogonal_distance(outline) ** 2
    return float(np.sqrt(squares.mean() / (ellipse.major * ellipse.minor)))


def _read_robust(rock: RockView) -> float | Reason:
    if not rock.resolved:
        return Reason.TOO_SMALL
    ellipse = fit_ellipse(rock.form_outline_px)
    return Reason.DEGENERATE if ellipse is None else ellipse_error(ellipse, rock.form_outline_px)


def _evaluate(rock: RockView) -> float:
    return (
        float("nan") if rock.ellipse is None else ellipse_error_px2(rock.ellipse, rock.outline_px)
    )


def _draw() -> "Figure":
    """Distances of an angular and a round outline from their ellipse along rays from its centre."""
    from rockshape.measures import drawing  # noqa: PLC0415 - brings Matplotlib

    figure, row = drawing.panels(2)
    samples = drawing.BY_ROUNDNESS[0], drawing.BY_ROUNDNESS[3]
    for panel, sample, title in zip(row, samples, ("angular", "round"), strict=True):
        outline = sample.traced_px()
        ellipse = drawing.fitted(outline)
        drawing.draw_rock(panel, outline)
        drawing.draw_ellipse(panel, ellipse)
        drawing.draw_radial_distances(panel, ellipse, outline[::9], linewidth=1.6)
        mean_px2 = ellipse_error_px2(ellipse, outline)
        share = np.sqrt(mean_px2 / (ellipse.major * ellipse.minor))
        panel.set_title(
            f"{title}\nmean square {mean_px2:.1f} px², RMS/√(ab) {share:.3f}", fontsize=9
        )
    return figure


PAPER = Measure(
    column="ellipse_error_px2",
    title="ellipse error",
    paper_name="ellipse fitting error",
    unit="px²",
    min_points=MIN_POINTS,
    evaluate=_evaluate,
    expected_trait="angularity",
    view_truth="outline_angularity",
    figure=_draw,
)
ROBUST = replace(PAPER, column="ellipse_error", unit="", evaluate=_read_robust, whole=True)
