"""3-D angularity: the second derivatives of a B-spline surface through the points.

Meaning: how sharply the visible surface bends: edges and corners; by `paper` relief as well.

Formula: `paper` the mean over the points of |(Q_uu + Q_ww)/2|, Q a B-spline surface over the image
plane (equations 12 to 17). `robust` the cube root of the third central moment of
-(r_xx + r_yy)/2, r the height over the held ellipsoid in the map that makes it the unit sphere, so
that the body's own curvature and size are out. The surface is sampled in even cells of 0.05 radii
and smoothed by 0.03, or by 0.45 of the points' distance where that is more. Bends count up to three
standard deviations from their mean, and less towards the limb. Edges bend outwards alone; relief
and range noise bend as far in as out and have no third moment, and third moments of what is
independent add up. Where range noise scatters the moment, the value is held to what the picture
tells: 1.7 ln(K/2) and at least 0, give or take 0.85, K = <|grad I|^4>/<|grad I|^2>^2 the kurtosis
of the brightness gradient over the rock, smoothed by 0.045 of its radius. It is 2 where brightness
undulates at random, and more where it changes at edges alone. The most likely value of the two is
taken: without noise that of range, in great noise that of shading. The flag `edges by shading`
marks values that range alone would not have.

Range and unit: `paper` 1/m, so half the size has twice the value; with u and w in 0..1 as the paper
has them it is in metres, times the patch's size squared. `robust` no unit: 0 for an ellipsoid,
about 1.1 for worn and 2.6 for sharp polyhedra.

Blind to: `paper` the rounding of edges, since across an edge the second derivative adds up to the
change of slope, however sharp or round it is; nor is it 0 on a sphere, where out to the radius r a
sphere of radius R has 1/sqrt(R² - r²), which grows without bound at the limb. It does not tell
edges from relief. The cube that `robust` takes does tell edges of different radius, down to about
0.03 of the rock's radius, below which they look alike. Relief and noise scatter it but do not raise
it. Creases that bend inwards count against edges; where they outweigh them the value is 0. Shading
does not know outward from inward, and takes the borders of shadows, of dust and of minerals for
edges; coarse texture and relief hide edges from it, so that a rougher rock looks rounder.

Smallest size: `paper` 100 points; its value falls as pixels grow. `robust` 200 facing points, about
22 px across. Where the picture has no contrast, it is `not resolvable` once the moment's standard
deviation by noise is above that of a value of 2.2: for a Navcam of 0.42 m baseline and rocks of
0.35 m from about 3 m on.

Degenerate: NaN where the surface is undetermined or, `robust`, the ellipsoid.

Source: Fox et al. (2002), equations 12 to 17.
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.measures.measure import Measure
from rockshape.measures.reading import Reason
from rockshape.rock.view import RockView
from rockshape.surface import (
    MIN_POINTS,
    Relief,
    Surface,
    fit_surface,
    view_patch,
    weigh_edges,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure


MIN_FACING = 200  # below this the value moves by more than 2 % with the grid


def angularity_3d_per_m(
    surface: Surface,
    *,
    signed: bool = False,
    body_per_m: NDArray[np.float64] | None = None,
) -> float:
    """Mean over the data points of |(Q_uu + Q_ww)/2|, in 1/m.

    `signed` gives equation 17 as printed, without the bars. Its bumps and hollows cancel: it is an
    integral over the rim, and ranks rocks of known roughness backwards. The absolute mean is used,
    as all published values are positive. Neither is 0 on a sphere: seen out to the radius r, a
    sphere of radius R scores 1/sqrt(R² - r²) and diverges at its limb. `body_per_m` (n,), from
    `rockshape.surface.body_bends_per_m`, is taken off before the mean; points where it is NaN,
    beyond the body's limb, are left out. NaN where none is left.

    Source: Fox et al. (2002), equations 16 and 17.
    """
    mean = (surface.second_uu_per_m + surface.second_ww_per_m) / 2
    if body_per_m is not None:
        mean = mean - body_per_m
        mean = mean[np.isfinite(mean)]
    if len(mean) == 0:
        return float("nan")
    return float(np.mean(mean if signed else np.abs(mean)))


def angularity_3d(relief: Relief, kurtosis: float = float("nan")) -> float:
    """Sharpness of a rock's edges; no unit.

    The cube root of the third moment of the outward bend, 0 where as much bends inwards; with noise
    held to what the gradient `kurtosis` of the rock's shading tells. NaN below 200 facing points,
    and without shading where the standard deviation of the moment by range noise is that of a value
    above 2.2.
    """
    if relief.facing < MIN_FACING:
        return float("nan")
    return weigh_edges(relief, kurtosis)


def _evaluate(rock: RockView) -> float:
    return float("nan") if rock.surface is None else angularity_3d_per_m(rock.surface)


def _evaluate_edges(rock: RockView) -> float | Reason:
    if rock.relief is None:
        return float("nan")
    if rock.relief.facing < MIN_FACING:
        return Reason.TOO_SMALL
    found = angularity_3d(rock.relief, rock.gradient_kurtosis)
    return Reason.NOT_RESOLVABLE if np.isnan(found) else found


def _draw() -> "Figure":
    """Height through the middle of a smooth and a rough cap, and its second derivative."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - half a second

    from rockshape.measures import drawing  # noqa: PLC0415

    figure = Figure(figsize=(6.4, 2.8), layout="constrained")
    panels = figure.subplots(2, 2, sharex=True)
    for column, (name, amplitude_m) in enumerate((("smooth", 0.0), ("rough", 0.002))):
        patch = view_patch(_cap(amplitude_m))
        surface = None if patch is None else fit_surface(patch)
        if patch is None or surface is None:
            raise ValueError("points: expected a patch that determines a surface")
        middle = np.abs(patch.w_m) < 0.0008
        order = np.argsort(patch.u_m[middle])
        u_mm = 1000 * patch.u_m[middle][order]
        bend_per_m = (surface.second_uu_per_m + surface.second_ww_per_m) / 2
        height, bend = panels[:, column]
        height.plot(u_mm, 1000 * patch.height_m[middle][order], color=drawing.INK)
        bend.fill_between(u_mm, bend_per_m[middle][order], color=drawing.SECOND, alpha=0.6)
        bend.axhline(0, color=drawing.QUIET, linewidth=0.8)
        bend.set(ylim=(-40, 40), xlabel="across, mm")
        value = angularity_3d_per_m(surface)
        height.set_title(f"{name}: mean |(Q$_{{uu}}$ + Q$_{{ww}}$)/2| = {value:.1f}", fontsize=9)
    panels[0, 0].set_ylabel("height, mm")
    panels[1, 0].set_ylabel("1/m")
    for panel in panels.flat:
        panel.spines[["top", "right"]].set_visible(False)
    return figure


def _cap(amplitude_m: float) -> NDArray[np.float64]:
    """Points (n, 3) of a cap of a sphere of 0.2 m with waves on it, seen from 3 m."""
    x, y = np.mgrid[-0.1:0.1:141j, -0.1:0.1:141j]
    inside = np.hypot(x, y) < 0.1
    height = np.sqrt(0.2**2 - x**2 - y**2)
    height += amplitude_m * np.sin(2 * np.pi * x / 0.06) * np.cos(2 * np.pi * y / 0.07)
    return np.asarray(np.stack([x, y, 3.0 - height], axis=-1)[inside])


PAPER = Measure(
    column="angularity_3d_per_m",
    title="3-D angularity",
    paper_name="3-D angularity",
    unit="1/m",
    needs_range=True,
    min_points=MIN_POINTS,
    evaluate=_evaluate,
    expected_trait="angularity",
    figure=_draw,
)
ROBUST = replace(
    PAPER,
    column="angularity_3d",
    unit="",
    min_points=MIN_FACING,
    evaluate=_evaluate_edges,
    constrained=True,
)
