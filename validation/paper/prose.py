"""What the paper says in its text only: figures 8 and 9, four hand-drawn shapes each.

The shares are differences between neighbouring shapes as a part of the measure's range. The
ellipse error is called a sum in the text; the tables' values fit the mean, in px².
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Quoted:
    """What figure 8 or 9 says of one measure: its ends, and how neighbouring shapes compare."""

    figure: int
    first: float
    last: float
    gaps: str


# Keyed by (series, measure).
FIGURES = {
    ("roundness", "angularity_2d_deg"): Quoted(
        8, 58.7734, 15.7935, "shapes 3 and 4 closer than 1 and 2"
    ),
    ("roundness", "ellipse_error_px2"): Quoted(
        8, 64.3312, 1.1258, "shapes 3 and 4 closer than 1 and 2"
    ),
    ("sphericity", "sphericity_2d"): Quoted(
        9, 0.19332, 0.95204, "1–2 differ by 2.4 % of the range, 2–3 by over 50 %"
    ),
    ("sphericity", "axis_ratio"): Quoted(
        9, 0.121, 0.89432, "1–2 differ by 2.7 % of the range, 2–3 by almost 39 %"
    ),
}
