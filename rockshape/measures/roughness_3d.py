"""3-D roughness: the height of relief below a scale that is a fixed share of the rock's size.

Meaning: how rough the rock's surface is, whatever its form.

Formula: 1.483 times the median of the absolute height over the smoothed surface, less the noise's
share: sqrt(rough² - noise²). Heights are taken along the normals of the held ellipsoid, over
(abc)^(1/3), in even cells of 0.05 radii of the visible surface; the smoothing length is 0.08 radii.
For heights with a normal distribution that is their RMS.

Range and unit: no unit: 0 for an ellipsoid. Waves of 2π/l radii keep (0.08 l)^4/(1 + (0.08 l)^4) of
their height: half at l = 12, nine tenths at l = 22, next to nothing below l = 6. So relief of
longer waves has less than its RMS, and the value ranks reliefs of like waves.

Blind to: waves longer than the rock's half-axes and finer than a pixel or a cell. Sharp edges are
not wholly out: smooth polyhedra have 0.004 when worn and 0.007 when sharp, a cube more.

Smallest size: 200 facing points, about 22 px across; waves finer than two pixels are gone. With
range noise it is `not resolvable` where the noise alone is rougher than the rock.

Degenerate: NaN where the ellipsoid is undetermined.

Source: none; the scales of roughness, roundness and form are told apart as Barrett (1980) does.
"""

from typing import TYPE_CHECKING

import numpy as np

from rockshape.measures.measure import Measure
from rockshape.measures.reading import Reason
from rockshape.numerics.robust_scale import MEDIAN_TO_SIGMA
from rockshape.rock.view import RockView
from rockshape.surface import RELIEF_SMOOTHING, HeightMap, Knots, Net, Relief

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MIN_FACING = 200  # points
MAX_NOISE_SHARE = 0.9  # of the seen height's variance, above which noise hides the relief


def roughness_3d(relief: Relief) -> float:
    """Robust RMS height of the relief over the rock's size, without the noise's share; no unit."""
    return float(np.sqrt(max(relief.rough**2 - relief.noise_rough**2, 0.0)))


def _evaluate(rock: RockView) -> float | Reason:
    relief = rock.relief
    if relief is None:
        return float("nan")
    if relief.facing < MIN_FACING:
        return Reason.TOO_SMALL
    if relief.noise_rough**2 > MAX_NOISE_SHARE * relief.rough**2:
        return Reason.NOT_RESOLVABLE
    return roughness_3d(relief)


def _draw() -> "Figure":
    """Section through an edge with and without relief, and what the smooth surface leaves of it."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - half a second

    from rockshape.measures import drawing  # noqa: PLC0415

    figure = Figure(figsize=(6.4, 2.8), layout="constrained")
    panels = figure.subplots(2, 2, sharex=True, sharey="row")
    side = np.linspace(-1, 1, 61)
    x, y = (grid.ravel() for grid in np.meshgrid(side, side, indexing="ij"))
    middle = y == side[30]
    for column, (name, rms) in enumerate((("smooth", 0.0), ("rough", 0.01))):
        waves = np.cos(23 * x + 5 * y) + np.cos(21 * y - 9 * x) + np.cos(17 * x - 15 * y + 1)
        height = -0.2 * np.abs(x) + rms * waves / waves.std()
        surface = HeightMap.of(Net(Knots(32), Knots(32)), np.column_stack([x, y]), height[:, None])
        fit = None if surface is None else surface.fit(RELIEF_SMOOTHING)
        if fit is None:
            raise ValueError("heights: expected a grid that determines a surface")
        left = height - fit.heights[:, 0]
        above, below = panels[:, column]
        above.plot(side, height[middle], color=drawing.INK)
        above.plot(side, fit.heights[middle, 0], color=drawing.SECOND)
        below.fill_between(side, left[middle], color=drawing.SECOND, alpha=0.6)
        below.axhline(0, color=drawing.QUIET, linewidth=0.8)
        below.set_xlabel("across, radii")
        value = MEDIAN_TO_SIGMA * float(np.median(np.abs(left)))
        above.set_title(f"{name}: 1.483 median |relief| = {value:.4f}", fontsize=9)
    panels[0, 0].set_ylabel("height, radii")
    panels[1, 0].set_ylabel("relief")
    for panel in panels.flat:
        panel.spines[["top", "right"]].set_visible(False)
    return figure


ROBUST = Measure(
    column="roughness_3d",
    title="3-D roughness",
    needs_range=True,
    min_points=MIN_FACING,
    evaluate=_evaluate,
    expected_trait="roughness",
    constrained=True,
    figure=_draw,
)
