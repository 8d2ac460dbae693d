"""2-D angularity: the spread of the angles that triangles inscribed in the outline have.

Meaning: how unevenly the outline bends: nothing on a circle, much where flat sides meet in
corners.

Formula: equations 6 and 7. At each point the flattest angle of the triangles whose other corners
lie 3 to 8 points before and after it; the measure is the standard deviation of those angles over
the outline. `paper`: over the boundary pixels. `robust`: over 100 points evenly along the outline's
form, smoothed by 0.12 of the radius of the disc of equal area, so that a triangle spans the same
share of any rock; and less what the ellipse of the same axes has, sqrt(spread² - ellipse's²), which
is form and no angularity.

Range and unit: from 0. `paper` in degrees; `robust` in radians, a pure number: 0 for any ellipse,
0.08 for a pebble, 0.23 for a sharp polygon of seven corners.

Blind to: the corners' number, as long as the bend is as uneven; `robust` to ripples shorter than
half the radius of the disc of equal area.

Smallest size: `paper` falls with size, since the staircase is what it sees: to a seventh from 30
to 1000 px on one and the same shape, and a disc scores 12 degrees at a radius of 6 px and 2.4 at
100 px; above 200 px it no longer ranks shapes (tau 0.98 at 200 px, 0.37 at 1000). `robust` holds
from 60 px on; docs/resolution.md has its order and level by size.

Degenerate: NaN for fewer than 17 points, where the triangles would meet behind the point. `robust`
leaves contacts out as roundness does, and refuses rocks that the frame cuts or less than 4 px wide.

Source: Fox et al. (2002), equations 6 and 7 and figure 3.
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipse.moments import moment_ellipse
from rockshape.measures.measure import Measure
from rockshape.measures.reading import Reason
from rockshape.outline.form import EVEN_POINTS, OutlineForm
from rockshape.outline.resample import even_outline
from rockshape.rock.view import MIN_OUTLINE_SHARE, RockView

if TYPE_CHECKING:
    from matplotlib.figure import Figure


ALPHA = 2
BETA = 9
_RING = 400  # points of an ellipse, between which lines stand for it


def angularity_2d_deg(
    outline_px: NDArray[np.float64], *, alpha: int = ALPHA, beta: int = BETA
) -> float:
    """Standard deviation over the outline of each point's flattest inscribed angle, in degrees.

    The angles are those of `flattest_angles_rad`; the measure is
    sqrt(sum (rho_i - mean rho)² / (N - 1)). outline_px is (N, 2) and closed. With alpha = 2 and
    beta = 9 the offsets are 3 to 8 on each side: 36 triangles a point.

    Rises with angularity. On pixels a circle does not score 0 but about 12, 7.2, 3.7 and 2.4
    degrees at a radius of 6, 20, 50 and 100 pixels, so the measure falls with size. NaN for fewer
    than 2 beta - 1 points, where the corners would meet behind the point.
    Source: Fox et al. (2002), equations 6 and 7 and figure 3.
    """
    if len(outline_px) < 2 * beta - 1:
        return float("nan")
    flattest = flattest_angles_rad(outline_px, alpha=alpha, beta=beta)
    return float(np.degrees(flattest.std(ddof=1)))


def flattest_angles_rad(
    outline_px: NDArray[np.float64], *, alpha: int = ALPHA, beta: int = BETA
) -> NDArray[np.float64]:
    """Flattest inscribed angle at each point of a closed outline (N, 2), (N,).

    At each point i the triangles with corners h and j, alpha < i - h < beta and
    alpha < j - i < beta, have the angle hij = arccos((a² + b² - c²)/(2ab)), with a, b the sides
    that meet at i; rho_i is the largest of them. N must be at least 2 beta - 1.

    The angle at i is pi less the turn from the chord that ends there to the one that starts there,
    so one arccos of the greatest product of their directions does for all triangles.
    A triangle with a side of no length is left out.
    Source: Fox et al. (2002), equation 6.
    """
    count = len(outline_px)
    chords = _unit_chords(outline_px, alpha + 1, beta - 1)
    starting = chords[:, :, beta - 1 :]
    best = np.full(starting.shape[1:], -1.0)
    product = np.empty_like(starting)
    for row, offset in enumerate(range(alpha + 1, beta)):
        # the chords of this offset that end at each point start so many points before it
        ending = chords[:, row, beta - 1 - offset : beta - 1 - offset + count]
        np.multiply(starting, ending[:, None], out=product)
        np.fmax(best, np.add(product[0], product[1], out=product[0]), out=best)
    return np.asarray(np.pi - np.arccos(np.minimum(best.max(axis=0), 1.0)))


def _unit_chords(outline: NDArray[np.float64], nearest: int, farthest: int) -> NDArray[np.float64]:
    """Directions (2, offsets, farthest + n) from points to those nearest...farthest on.

    Column farthest + i belongs to point i; the columns before it are the last points', so that
    the chords that end at a point lie before those that start there. NaN for no length.
    """
    ring = np.concatenate([outline[-farthest:], outline, outline[:farthest]]).T.copy()
    columns = len(outline) + farthest
    chords = np.empty((2, farthest - nearest + 1, columns))
    for row, offset in enumerate(range(nearest, farthest + 1)):
        np.subtract(ring[:, offset : offset + columns], ring[:, :columns], out=chords[:, row])
    length = np.sqrt(chords[0] ** 2 + chords[1] ** 2)
    with np.errstate(invalid="ignore"):
        chords /= length
    return chords


def angularity_beyond_form(
    form: OutlineForm, own: NDArray[np.bool_] | None = None, *, alpha: int = ALPHA
) -> float:
    """What the spread of the flattest angles has beyond that of the form's ellipse, in radians.

    sqrt(spread² - ellipse's spread²) over 100 even points each, 0 where the ellipse bends as
    unevenly: an ellipse twice as long as wide has a spread of 0.09 that is form and no angularity.
    The ellipse has the outline's second moments. own (100,) says which even points are the rock's
    own outline; all by default. NaN where there is no ellipse or fewer than two of them.
    """
    ellipse = moment_ellipse(form.points)
    if ellipse is None:
        return float("nan")
    angles = flattest_angles_rad(form.even_points, alpha=alpha)
    angles = angles if own is None else angles[own]
    ring = even_outline(ellipse.ring(_RING), EVEN_POINTS)
    smooth = flattest_angles_rad(ring, alpha=alpha).std(ddof=1)
    if len(angles) < 2:
        return float("nan")
    bends = angles.std(ddof=1)
    return float(np.sqrt(max(0.0, bends**2 - smooth**2)))


def _read_robust(rock: RockView) -> float | Reason:
    if not rock.resolved:
        return Reason.TOO_SMALL
    if rock.form is None:
        return Reason.DEGENERATE
    if rock.outline_share < MIN_OUTLINE_SHARE:
        return Reason.CONTACTS
    return angularity_beyond_form(rock.form, rock.is_own(rock.form_outline_px))


def _evaluate(rock: RockView) -> float:
    return angularity_2d_deg(rock.outline_px)


def _draw() -> "Figure":
    """Flattest angles along an angular and a round outline, beside two points' triangles."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - half a second
    from matplotlib.patches import Polygon  # noqa: PLC0415

    from rockshape.measures import drawing  # noqa: PLC0415

    figure = Figure(figsize=(6.4, 2.5), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(1, 1.6))
    left.set_aspect("equal")
    left.axis("off")
    angular, rounded = drawing.BY_ROUNDNESS[0], drawing.BY_ROUNDNESS[3]
    outline = angular.traced_px(scale=0.3)
    drawing.draw_rock(left, outline)
    left.plot(*outline.T, "s", color=drawing.INK, markersize=1.5)
    flattest = flattest_angles_rad(outline)
    for index, colour in ((flattest.argmin(), drawing.SECOND), (flattest.argmax(), drawing.FIRST)):
        for reach in (3, 5, 8):
            triangle = outline[[index - reach, index, (index + reach) % len(outline)]]
            left.add_patch(Polygon(triangle, fill=False, edgecolor=colour, linewidth=1.2))
        left.plot(*outline[index], "o", color=colour, markersize=4)
    for sample, colour, name in (
        (angular, drawing.SECOND, "angular"),
        (rounded, drawing.FIRST, "round"),
    ):
        angles = np.degrees(flattest_angles_rad(sample.traced_px()))
        label = f"{name}: spread {angles.std(ddof=1):.1f}°"
        along = np.linspace(0, 1, len(angles))
        right.plot(along, angles, color=colour, linewidth=1, label=label)
    right.set(xlabel="along the outline", ylabel="flattest angle, °", ylim=(100, 182))
    right.legend(frameon=False, fontsize=8, loc="lower right", ncols=2)
    right.spines[["top", "right"]].set_visible(False)
    return figure


PAPER = Measure(
    column="angularity_2d_deg",
    title="2-D angularity",
    paper_name="2-D angularity",
    unit="°",
    min_points=2 * BETA - 1,
    evaluate=_evaluate,
    expected_trait="angularity",
    view_truth="outline_angularity",
    value_range=(0.0, 180.0),
    figure=_draw,
)
ROBUST = replace(
    PAPER,
    column="angularity_2d",
    unit="",
    evaluate=_read_robust,
    whole=True,
    value_range=(0.0, float(np.pi)),
)
