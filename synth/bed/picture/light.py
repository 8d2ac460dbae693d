"""Light on a bed: sun with cast shadows, sky seen from hollows, and light between stones."""

from dataclasses import dataclass

import cv2
import numpy as np

from synth.arrays import Singles
from synth.spec.bed import BedLightSpec

_BOUNCE = 0.4  # share of the reflected light that reaches what sees no sky
_LOW_SUN = 0.25  # sine of the elevation below which level ground stays darker than white
_HOLLOW = 1.3  # power of the seen share of the sky: light from low in the sky is weaker


@dataclass(frozen=True)
class BedLight:
    """Light of one tile."""

    azimuth_rad: float  # towards the sun, from +x (columns) towards +y (rows, down)
    elevation_rad: float
    sky: float  # share of the sky in the light on level ground
    overcast: bool
    warmth: float  # 0: sun and sky both white, 1: yellow sun, blue sky

    def towards_sun(self) -> Singles:
        """Unit vector (3,) along columns, rows and towards the camera."""
        level = np.cos(self.elevation_rad)
        east, south = level * np.cos(self.azimuth_rad), level * np.sin(self.azimuth_rad)
        return np.array([east, south, np.sin(self.elevation_rad)], dtype=np.float32)


def draw_light(spec: BedLightSpec, rng: np.random.Generator) -> BedLight:
    """Light drawn from a spec's ranges."""
    azimuth_deg, elevation_deg = rng.uniform(*spec.azimuth_deg), rng.uniform(*spec.elevation_deg)
    overcast = bool(rng.uniform() < spec.overcast)
    clear, clouded = rng.uniform(*spec.sky), rng.uniform(0.75, 1.0)
    return BedLight(
        azimuth_rad=float(np.deg2rad(azimuth_deg)),
        elevation_rad=float(np.deg2rad(elevation_deg)),
        sky=float(clouded if overcast else clear),
        overcast=overcast,
        warmth=float(rng.uniform()),
    )


@dataclass(frozen=True, eq=False)
class LitRelief:
    """Samples of a view with the light that arrives at them."""

    height_px: Singles  # (rows, cols), vertical
    normals: Singles  # (rows, cols, 3), along columns, rows and towards the camera
    up: Singles  # (rows, cols), the normals' vertical component
    sunlit: Singles  # (rows, cols), 0 in cast shadow, 1 in the sun; attached shadow is not here
    arriving: Singles  # (rows, cols, 3), on a sample of that slope, 1 on level ground


def sunlit_share(shadow_depth_px: Singles, per_px: int) -> Singles:
    """Share of the sun that is seen, by the depth in a shadow: edges are a sample wide."""
    lit = np.maximum(np.float32(1.0) - shadow_depth_px * np.float32(per_px), np.float32(0.0))
    return np.asarray(lit)


def arriving_light(
    light: BedLight, normals: Singles, *, sunlit: Singles, sky: Singles, albedo: float
) -> Singles:
    """Light that arrives, (rows, cols, 3), in red, green and blue.

    The normals' third component is vertical, `sky` the share of the sky that is seen, `albedo` the
    mean of what reflects the light.
    """
    sun = light.towards_sun()
    direct = np.maximum(normals @ sun, np.float32(0.0)) * sunlit
    direct *= np.float32((1.0 - light.sky) / max(float(sun[2]), _LOW_SUN))
    above = np.float32(0.55) + np.float32(0.45) * normals[..., 2]
    ambient = np.float32(light.sky) * cv2.pow(sky, _HOLLOW) * above
    bounce = np.float32(_BOUNCE * albedo * (1.0 - 0.5 * light.sky)) * (np.float32(1.0) - sky)
    blue = 0.0 if light.overcast else light.warmth
    of_sun = np.array([1.0 + 0.06 * light.warmth, 1.0, 1.0 - 0.12 * light.warmth], np.float32)
    of_sky = np.array([1.0 - 0.12 * blue, 1.0, 1.0 + 0.15 * blue], np.float32)
    return np.stack(
        [(direct + bounce) * one + ambient * two for one, two in zip(of_sun, of_sky, strict=True)],
        axis=-1,
    )
