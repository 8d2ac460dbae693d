"""Edges of a rock by its range and by its shading, each for as much as it tells."""

import numpy as np

from rockshape.surface.residual_curvature import Relief

RANDOM = 2.0  # gradient kurtosis of a surface without edges
# of a fit to made rocks under drawn light and surfaces, on seeds below 1000:
RISE = 1.7  # angularity of a rock whose kurtosis is e times that
SHADING_SD = 0.85  # standard deviation of the angularity that shading tells


def weigh_edges(relief: Relief, kurtosis: float) -> float:
    """Angularity from a surface's relief and the gradient kurtosis of its shading.

    Range tells the third moment of the bend, m, whose standard deviation by range noise is N;
    shading tells g = 1.7 ln(kurtosis/2), at least 0, give or take 0.85. The angularity v is the
    most likely: it minimises (m - v³)²/N² + (v - g)²/0.85². Where N is 0 it is the cube root of m,
    in great noise g; where the two contradict each other, a little noise more can make it leap from
    one to the other. Without shading, a kurtosis of NaN, it is the cube root of m; NaN where range
    alone does not resolve edges.
    """
    moment, noise = relief.edge_bend_cubed, relief.noise_bend_cubed
    if np.isnan(kurtosis):
        return float(np.cbrt(max(moment, 0.0))) if relief.resolves_edges else float("nan")
    told = RISE * max(float(np.log(kurtosis / RANDOM)), 0.0)
    return _most_likely(moment, noise, told)


def _most_likely(moment: float, noise: float, told: float) -> float:
    """The v from 0 that minimises (moment - v³)²/noise² + (v - told)²/SHADING_SD²."""
    steep = 3.0 * SHADING_SD**2
    roots = np.roots([steep, 0.0, 0.0, -steep * moment, noise**2, -(noise**2) * told])
    places = np.append(roots.real[(np.abs(roots.imag) < 1e-6) & (roots.real > 0.0)], 0.0)
    misfit = steep / 3.0 * (moment - places**3) ** 2 + noise**2 * (places - told) ** 2
    return float(places[np.argmin(misfit)])
