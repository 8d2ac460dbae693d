"""2-D sphericity: the aspect ratio of the outline.

Meaning: how wide the outline is for its length, as a box or callipers would tell it.

Formula: `paper`: short over long side of the upright box; the paper says no more than "aspect
ratio", and among the candidates this one agrees best with its table 4. `robust`: least over
greatest Feret diameter of the sub-pixel outline. The smallest rectangle's sides would do for
boxes, but of rounder shapes a jitter of a third of a pixel makes another rectangle the smallest:
on drawn shapes its ratio had an RMS error of 0.017 against 0.004 for the Feret diameters'.

Range and unit: 0 to 1, a pure number. `robust`: 1 for a circle, b/a for an ellipse, 0.71 for a
square, whose diagonal counts as its length.

Blind to: corners, but for the diagonal they make. `paper` changes when the picture is turned: a
thin rock at 45 degrees scores 1.

Smallest size: `robust`: 2.9 % high at 30 px, 0.9 % at 100 px, 0.1 % at 500 px beside its value at
1000 px; boxes from oblong to square keep their order at every size at any turn (tau 1, where the
paper's has 0.60 to 0.70).

Degenerate: `paper`: NaN for an empty outline only. `robust` refuses rocks that the frame cuts or
less than 4 px wide.

Source: Fox et al. (2002), section 3, Sphericity Test; Feret (1930).
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.measures.measure import Measure
from rockshape.measures.reading import Reason
from rockshape.outline.extent import feret_diameters
from rockshape.rock.view import RockView

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def sphericity_2d(outline_px: NDArray[np.float64]) -> float:
    """Short over long side of the outline's upright bounding box, (0, 1].

    outline_px is (n, 2), centres of boundary pixels, so a side is the extent plus one pixel.
    The paper says no more than "aspect ratio"; among the candidates this one agrees best with its
    table 4. It changes when the image is turned: a thin rock at 45 degrees scores 1.
    NaN for an empty outline.
    Source: Fox et al. (2002), section 3, Sphericity Test.
    """
    if len(outline_px) == 0:
        return float("nan")
    sides = np.ptp(outline_px.T.copy(), axis=1) + 1
    return float(sides.min() / sides.max())


def _read_robust(rock: RockView) -> float | Reason:
    if not rock.resolved:
        return Reason.TOO_SMALL
    least, greatest = rock.feret_px
    return least / greatest


def _evaluate(rock: RockView) -> float:
    return sphericity_2d(rock.outline_px)


def _draw() -> "Figure":
    """Upright box and Feret diameters of a rock, and of the same rock turned."""
    from rockshape.measures import drawing  # noqa: PLC0415 - brings Matplotlib

    figure, row = drawing.panels(2)
    for panel, turn_rad in zip(row, (0.0, np.pi / 4), strict=True):
        outline = drawing.BY_FORM[1].traced_px(turn_rad=turn_rad)
        drawing.draw_rock(panel, outline)
        low, high = outline.min(axis=0), outline.max(axis=0)
        box = np.array([low, (high[0], low[1]), high, (low[0], high[1]), low])
        panel.plot(*box.T, color=drawing.SECOND, linewidth=1.4, linestyle="--")
        arrow = {"arrowstyle": "|-|", "color": drawing.FIRST, "linewidth": 1.4, "shrinkA": 0}
        for start, end in _feret_ends(outline):
            panel.annotate("", start, end, arrowprops=arrow | {"shrinkB": 0, "mutation_scale": 4})
        upright = (high - low).min() / (high - low).max()
        least, greatest = feret_diameters(outline)
        panel.set_title(f"upright box {upright:.2f}, callipers {least / greatest:.2f}", fontsize=9)
        drawing.close_margins(panel)
    return figure


def _feret_ends(outline: NDArray[np.float64]) -> list[tuple[tuple[float, float], ...]]:
    """Ends of the least and the greatest diameter in whole degrees, through the box's middle."""
    turns = np.radians(np.arange(180))
    ways = np.column_stack([np.cos(turns), np.sin(turns)])
    reach = outline @ ways.T
    middle = (outline.min(axis=0) + outline.max(axis=0)) / 2
    found = []
    for place in (np.ptp(reach, axis=0).argmin(), np.ptp(reach, axis=0).argmax()):
        way = ways[place]
        ends = (middle + (end(reach[:, place]) - middle @ way) * way for end in (np.min, np.max))
        found.append(tuple((float(x), float(y)) for x, y in ends))
    return found


PAPER = Measure(
    column="sphericity_2d",
    title="2-D sphericity",
    paper_name="2-D sphericity",
    min_points=1,
    evaluate=_evaluate,
    expected_trait="form",
    view_truth="outline_axis_ratio",
    equals="outline_rectangle_ratio",
    value_range=(0.0, 1.0),
    figure=_draw,
)
ROBUST = replace(PAPER, evaluate=_read_robust, whole=True)
