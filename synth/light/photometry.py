"""Photometry: brightness of a surface under sun and sky, seen from a direction."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats, Singles
from synth.spec.surface import SurfaceSpec
from synth.spec.view import SunSpec

Reals = NDArray[np.floating[Any]]

EXPOSURE = 1.35  # brightness of a white level surface under the whole light
SKY = 0.75  # brightness of the sky itself
BOUNCE = 0.4  # share of the sky's light that a surface facing down gets back from the ground
_MIN_SINE = 0.5  # the exposure follows the sun down to this sine of its elevation
_USUAL_EMISSION = np.cos(
    np.deg2rad(80.0)
)  # level ground seen at this angle has E ρ; most is darker


def towards_sun(sun: SunSpec) -> Floats:
    """Unit vector towards the sun, (3,)."""
    azimuth_rad, elevation_rad = np.deg2rad(sun.azimuth_deg), np.deg2rad(sun.elevation_deg)
    level = np.cos(elevation_rad)
    return np.array(
        [level * np.cos(azimuth_rad), level * np.sin(azimuth_rad), np.sin(elevation_rad)]
    )


def sun_strength(sun: SunSpec) -> float:
    """Brightness that the sun alone gives to a white Lambertian surface that faces it."""
    return EXPOSURE * (1.0 - sun.ambient) / max(float(towards_sun(sun)[2]), _MIN_SINE)


def lunar_share(surface: SurfaceSpec) -> float:
    """Weight L of Lommel–Seeliger in the surface's law."""
    return {"lambert": 0.0, "lommel-seeliger": 1.0}.get(surface.law, surface.lunar_share)


def reflected(incidence: Reals, emission: Reals, share: float) -> Reals:
    """Reflectance of a white surface for the sun's light, (n,).

    L · 2 μ₀/(μ₀ + μ) + (1 − L) μ₀ with the cosines of incidence μ₀ and emission μ, the
    lunar-Lambert law (McEwen 1991): L = 0 is Lambert's, L = 1 Lommel and Seeliger's. A surface
    turned away from the sun, μ₀ <= 0, gives nothing.
    """
    lit = np.maximum(incidence, 0.0)
    if share == 0.0:
        return np.asarray(lit)
    seen = np.maximum(emission, 1e-3)
    return np.asarray(lit * ((1.0 - share) + 2.0 * share / (lit + seen)))


def light(
    upward: Singles, incidence: Singles, emission: Singles, sun: SunSpec, surface: SurfaceSpec
) -> tuple[Singles, Singles]:
    """Brightness of white surfaces under the sky and under the sun, (n,) each.

    Their sum is 1 for level ground in the sun: k (1 − β(1 − n_z)/2) of the sky and
    (1 − k) R(μ₀, μ)/R(s_z, cos 80°) of the sun: k the sky's share, β what the ground
    does not give back, `upward` n_z, R the law of `reflected`; μ₀ is 0 in shadow. s_z counts as
    0.5 at least, so that a low sun does not overexpose what faces it.
    """
    share = lunar_share(surface)
    height = np.array(max(towards_sun(sun)[2], _MIN_SINE))
    unit = float(reflected(height, np.array(_USUAL_EMISSION), share))
    sky = 1.0 - (1.0 - BOUNCE) * (1.0 - upward) / 2.0
    direct = reflected(incidence, emission, share) / unit
    return (
        np.asarray(sun.ambient * sky, dtype=np.float32),
        np.asarray((1.0 - sun.ambient) * direct, dtype=np.float32),
    )
