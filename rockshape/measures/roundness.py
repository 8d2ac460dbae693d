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

Smallest size: on 243 rounded polygons of known roundness 0.1 to 0.9, any form and turn, Pearson's
r, bias and RMS error are .87, +.05, .14 at 30 px; .977, -.00, .06 at 60 px; .991, -.01, .04 at 100
px; .995, -.01, .03 at 200 px; .998, -.01, .02 at 500 px; .999, -.01, .015 at 1000 px. fast_rs on
the same pictures has r .43, .78, .86 and .93 up to 200 px, and a bias of .4. A disc comes out at
.91 at 60 px and .99 at 200 px, a stadium at .92 at 200 px; the ends of an ellipse of 0.4, at .46.
Corners that are many are small: on 84 outlines of rounded polyhedra, with some eleven corners each,
r is .51, .62, .76, .89, .98 and .99 at the same six sizes, with a bias of +.27, +.17, +.12, +.06,
+.02 and +.01. Such rocks want 200 px (`python benchmarks/roundness.py`).

Degenerate: 1 where there is no corner. Refuses rocks that the frame cuts, less than 4 px wide or
with an outline of fewer than 40 px.

Source: Wadell (1932), Volume, shape, and roundness of rock particles.
"""

from rockshape.measures.measure import Measure
from rockshape.measures.reading import Reason
from rockshape.outline.roundness import MIN_POINTS, wadell_roundness
from rockshape.rock.view import RockView


def _read_robust(rock: RockView) -> float | Reason:
    return wadell_roundness(rock.smooth_outline_px) if rock.resolved else Reason.TOO_SMALL


ROBUST = Measure(
    column="roundness",
    title="roundness",
    paper_name="",
    unit="",
    needs_range=False,
    min_points=MIN_POINTS,
    evaluate=_read_robust,
    whole=True,
    expected_trait="roundness",
    view_truth="outline_roundness",
    equals=("outline_roundness", "roundness"),
    value_range=(0.0, 1.0),
)
