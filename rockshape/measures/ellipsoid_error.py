"""Ellipsoid fitting error: how far the visible surface lies from its ellipsoid.

Meaning: a rock whose faces are flat and whose edges are sharp lies farther from an ellipsoid than a
worn one.

Formula: `paper` D_S/N, the mean squared distance of the points from their ellipsoid, along the ray
from its centre (equation 8). `robust` a robust scale of the distances e from the constrained
ellipsoid over the geometric mean of its half-axes, sqrt(s² - noise²)/(abc)^(1/3), with the
biweight M-scale s: mean ρ(e/(2.5 s)) = 0.3092, ρ(u) = 1 - (1 - u²)³ up to |u| = 1 and 1 beyond, the
standard deviation of normal e; noise is what the range's own scatter makes of it. Flying pixels,
spikes and far points are left out: those farther than six times 1.4826 median |e|, or on the far
side.

Range and unit: `paper` m², growing with the square of the size; `robust` no unit, 0 for an
ellipsoid, about 0.06 for sharp polyhedra.

Blind to: whether a distance is form or angularity: a smooth box has more than a worn boulder. And
to where it lies, and to what is not seen: the far side, or what the frame cuts off.

Smallest size: 30 points. With noise it is blind sooner than sphericity: `robust` is `not
resolvable` where the noise alone is more than 0.06, or more than the whole distance.

Degenerate: as 3-D sphericity.

Source: Fox et al. (2002), section 2, Ellipsoid Fitting, after equation 11.
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid import MIN_POINTS, Ellipsoid, EllipsoidFit
from rockshape.measures.measure import Measure
from rockshape.measures.reading import Reason
from rockshape.numerics.robust_scale import biweight_scale
from rockshape.outline.resample import even_outline
from rockshape.rock.view import RockView

if TYPE_CHECKING:
    from matplotlib.figure import Figure


MAX_NOISE = 0.06  # of the mean half-axis, which is the whole range of the measure


def ellipsoid_error_m2(fit: EllipsoidFit) -> float:
    """Mean squared radial distance of the points from the fitted ellipsoid, D_S / N, in m².

    Source: Fox et al. (2002), section 2, Ellipsoid Fitting, after equation 11.
    """
    return fit.mean_square_m2


def ellipsoid_error(
    ellipsoid: Ellipsoid, points_m: NDArray[np.float64], *, noise_m: float = 0.0
) -> float:
    """Robust scale of points' (n, 3) radial distances from an ellipsoid over its mean half-axis.

    sqrt(s² - noise²)/(abc)^(1/3) with s the biweight M-scale of the distances, the standard
    deviation of normal ones. noise_m is the RMS distance that the range's own scatter makes; 0 is
    left where it is more. NaN for no points.
    """
    if len(points_m) == 0:
        return float("nan")
    square = biweight_scale(ellipsoid.radial_distance_m(points_m)) ** 2
    mean_axis_m = float(np.cbrt(ellipsoid.half_axes_m.prod()))
    return float(np.sqrt(max(square - noise_m**2, 0.0))) / mean_axis_m


def _noise_m(rock: RockView, body: Ellipsoid) -> float:
    """RMS distance from the surface that the range's scatter makes: dz moves a point dz p.n/z."""
    if rock.noise is None:
        return 0.0
    points_m = rock.sound_points_m
    normals = body.to_sphere(points_m) / body.half_axes_m @ body.axes
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    depth = points_m[:, 2]
    across = rock.noise.depth_sd_m(depth) * (normals * points_m).sum(axis=1) / depth
    return float(np.sqrt(np.mean(across**2)))


def _evaluate_held(rock: RockView) -> float | Reason:
    body = rock.held_ellipsoid
    if body is None:
        return float("nan")
    noise_m = _noise_m(rock, body)
    error = ellipsoid_error(body, rock.sound_points_m, noise_m=noise_m)
    hidden = noise_m > MAX_NOISE * float(np.cbrt(body.half_axes_m.prod())) or error == 0 < noise_m
    return Reason.NOT_RESOLVABLE if hidden else error


def _evaluate(rock: RockView) -> float:
    return float("nan") if rock.ellipsoid is None else ellipsoid_error_m2(rock.ellipsoid)


def _draw() -> "Figure":
    """Section of a rock, points seen from one side, and their distances from the ellipsoid."""
    from matplotlib.patches import Polygon  # noqa: PLC0415 - half a second

    from rockshape.measures import drawing  # noqa: PLC0415

    figure, (panel,) = drawing.panels(1)
    section = even_outline(drawing.BY_ROUNDNESS[1].outline_px() / 1000, 180)
    section -= section.mean(axis=0)
    bearing = np.arctan2(section[:, 1], section[:, 0])
    visible = section[np.abs(np.abs(bearing) - np.pi) < 1.5][::2]
    panel.add_patch(
        Polygon(section, facecolor=drawing.ROCK, edgecolor=drawing.QUIET, linestyle=":")
    )
    ellipse = drawing.fitted(section)
    drawing.draw_ellipse(panel, ellipse)
    drawing.draw_radial_distances(panel, ellipse, visible, linewidth=1.4)
    panel.plot(*visible.T, "o", color=drawing.INK, markersize=1.6)
    left = float(section[:, 0].min())
    arrow = {"arrowstyle": "->", "color": drawing.QUIET}
    for side in (-0.05, 0.0, 0.05):
        panel.annotate("", (left - 0.006, side), (left - 0.06, side), arrowprops=arrow)
    panel.set_title(
        "points seen from the left, and how far they lie from the ellipsoid", fontsize=9
    )
    drawing.close_margins(panel)
    return figure


PAPER = Measure(
    column="ellipsoid_error_m2",
    title="ellipsoid error",
    paper_name="ellipsoid fitting error",
    unit="m²",
    needs_range=True,
    min_points=MIN_POINTS,
    evaluate=_evaluate,
    expected_trait="angularity",
    figure=_draw,
)
ROBUST = replace(
    PAPER, column="ellipsoid_error", unit="", evaluate=_evaluate_held, constrained=True
)
