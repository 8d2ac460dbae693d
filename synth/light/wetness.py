"""Wet surfaces: darker, and with a highlight of the sun in the film of water."""

import numpy as np

from synth.arrays import Singles

_INDEX = 1.33  # of water
_NORMAL_REFLECTANCE = ((_INDEX - 1.0) / (_INDEX + 1.0)) ** 2  # Fresnel's, 0.02
_SHARPNESS = 60.0  # exponent of the highlight's lobe: a film on a rough surface


def wetted(reflectance: Singles, wetness: float) -> Singles:
    """Reflectance of surfaces that are wet to a share: ρ/(n² (1 − ρ) + ρ) under the film.

    Source: Ångström (1925): light that the surface scatters is reflected inside the film's
    top but for 1/n², and scattered again.
    """
    under = reflectance / (np.float32(_INDEX**2) * (1.0 - reflectance) + reflectance)
    return np.asarray(reflectance + np.float32(wetness) * (under - reflectance))


def highlight(normals: Singles, towards_eye: Singles, towards_sun: Singles) -> Singles:
    """Sun's light in a film of water over that of a white surface that faces the sun, (n,).

    F (m + 8)/8 (n·h)^m μ₀ with h midway between eye and sun, Schlick's F = F₀ + (1 − F₀)
    (1 − h·s)^5 and μ₀ = n·s (Blinn 1977, normalised). All vectors have unit length.
    """
    middle = towards_eye + towards_sun
    middle = middle / np.linalg.norm(middle, axis=1, keepdims=True)
    fresnel = _NORMAL_REFLECTANCE + (1.0 - _NORMAL_REFLECTANCE) * (1.0 - middle @ towards_sun) ** 5
    facing = np.maximum(np.einsum("ij,ij->i", normals, middle), 0.0)
    lobe = (_SHARPNESS + 8.0) / 8.0 * facing**_SHARPNESS
    lit = np.maximum(normals @ towards_sun, 0.0)
    return np.asarray(fresnel * lobe * lit, dtype=np.float32)
