"""Sample outlines, colours and panels for the figures of the measures.

A measure's `figure` imports this module when it draws, and with it Matplotlib. The samples are
convex polygons rounded by a disc, so that their roundness is known.
"""

from dataclasses import dataclass

import cv2
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from rockshape.ellipse.direct import Ellipse, fit_ellipse
from rockshape.numerics.arrays import Floats
from rockshape.outline.extent import convex_hull
from rockshape.outline.trace import trace_outline

INK, ROCK, FIRST, SECOND, QUIET = "#1d2329", "#d9cfc1", "#1f6fb2", "#c4561b", "#8b9299"
ARC_POINTS = 320  # on a whole turn
FINE = 16  # steps of a pixel in which polygons are filled


@dataclass(frozen=True)
class SampleOutline:
    """Rounded polygon: the points within a radius of a convex polygon; y up, pixels."""

    x_px: tuple[float, ...]  # of the polygon's corners
    y_px: tuple[float, ...]
    radius_px: float
    roundness: float  # radius_px over the radius of the largest inscribed disc

    def outline_px(self) -> Floats:
        """Points (n, 2) on the outline."""
        turns = np.linspace(0, 2 * np.pi, ARC_POINTS, endpoint=False)
        arc = self.radius_px * np.column_stack([np.cos(turns), np.sin(turns)])
        corners = np.column_stack([self.x_px, self.y_px])
        return convex_hull((corners[:, None] + arc).reshape(-1, 2))

    def traced_px(self, *, turn_rad: float = 0.0, scale: float = 1.0) -> Floats:
        """Boundary pixels (n, 2) of the outline on a pixel grid, y down."""
        points = self.outline_px() * (scale, -scale)
        cosine, sine = np.cos(turn_rad), np.sin(turn_rad)
        points = points @ np.array([[cosine, sine], [-sine, cosine]])
        points -= points.min(axis=0) - 5
        mask = np.zeros(np.ceil(points.max(axis=0)[::-1]).astype(int) + 6, dtype=np.uint8)
        cv2.fillPoly(mask, [np.rint(points * FINE).astype(np.int32)], (1,), shift=4)
        return trace_outline(mask.astype(bool))


BY_ROUNDNESS = (
    SampleOutline(
        x_px=(-37.75, 68.46, 85.63, 62.07, -3.63, -60.80, -80.54),
        y_px=(-56.66, -56.66, -12.58, 37.00, 72.11, 62.49, -8.62),
        radius_px=1.916,
        roundness=0.03,
    ),
    SampleOutline(
        x_px=(-30.61, 55.51, 69.43, 50.32, -2.94, -49.30, -65.30),
        y_px=(-42.83, -42.83, -9.51, 27.97, 54.50, 47.23, -6.52),
        radius_px=17.636,
        roundness=0.27,
    ),
    SampleOutline(
        x_px=(-13.68, 52.29, 55.35, 32.17, -14.68, -48.54, -48.54),
        y_px=(-32.33, -17.96, 5.54, 26.18, 34.16, 21.80, -15.04),
        radius_px=33.054,
        roundness=0.51,
    ),
    SampleOutline(
        x_px=(-9.38, 35.85, 37.95, 22.06, -10.07, -33.28, -33.28),
        y_px=(-16.45, -9.14, 2.82, 13.32, 17.38, 11.09, -7.65),
        radius_px=49.387,
        roundness=0.75,
    ),
)
"""Samples of one form from angular to round."""

BY_FORM = (
    SampleOutline(
        x_px=(-89.38, 88.94, 89.38, -88.94),
        y_px=(-4.53, -9.86, 4.53, 9.86),
        radius_px=10.8,
        roundness=0.6,
    ),
    SampleOutline(
        x_px=(-59.79, 62.05, 59.79, -62.05),
        y_px=(-24.38, -17.84, 24.38, 17.84),
        radius_px=31.709,
        roundness=0.6,
    ),
    SampleOutline(
        x_px=(-31.29, 29.25, 31.29, -29.25),
        y_px=(-26.29, -28.54, 26.29, 28.54),
        radius_px=41.151,
        roundness=0.6,
    ),
)
"""Rounded rectangles from oblong to nearly square."""


def panels(count: int) -> tuple[Figure, list[Axes]]:
    """Figure of panels side by side, without axes, x and y on one scale."""
    figure = Figure(figsize=(6.4, 2.5), layout="constrained")
    row = list(figure.subplots(1, count, squeeze=False)[0])
    for panel in row:
        panel.set_aspect("equal")
        panel.axis("off")
    return figure, row


def draw_rock(panel: Axes, outline: Floats) -> None:
    """Fill an outline (n, 2), y down."""
    panel.add_patch(Polygon(outline, facecolor=ROCK, edgecolor=INK, linewidth=1.2))
    panel.autoscale_view()
    panel.invert_yaxis()


def fitted(outline: Floats) -> Ellipse:
    """Ellipse of an outline that determines one."""
    ellipse = fit_ellipse(outline)
    if ellipse is None:
        raise ValueError("outline: expected one that determines an ellipse")
    return ellipse


def draw_ellipse(panel: Axes, ellipse: Ellipse) -> None:
    """Draw an ellipse's line."""
    ring = ellipse.ring()
    panel.plot(*np.vstack([ring, ring[:1]]).T, color=FIRST, linewidth=1.4)


def draw_radial_distances(
    panel: Axes, ellipse: Ellipse, points: Floats, *, linewidth: float
) -> None:
    """Draw the way from each point (n, 2) to the ellipse along the ray from its centre."""
    centre = np.array([ellipse.x, ellipse.y])
    for point, along in zip(points, ellipse.radial_distance(points), strict=True):
        ray = point - centre
        foot = point - ray / np.hypot(*ray) * along
        panel.plot(*np.array([point, foot]).T, color=SECOND, linewidth=linewidth)


def close_margins(panel: Axes) -> None:
    """Leave a narrow margin round what is drawn."""
    panel.margins(0.04)
    panel.autoscale_view()
