"""Light on a bed: sun with cast shadows, sky seen from hollows, and light between stones."""

from dataclasses import dataclass

import cv2
import numpy as np

from synth.arrays import Singles
from synth.bed.picture.shadows import normals_of, shadow_depth, sky_share
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
    """Light that arrives at a height field's samples."""

    normals: Singles  # (rows, cols, 3)
    sunlit: Singles  # (rows, cols), 0 in cast shadow, 1 in the sun; attached shadow is not here
    arriving: Singles  # (rows, cols, 3), on a sample of that slope, 1 on level ground


def shine(height_px: Singles, per_px: int, light: BedLight, *, albedo: float) -> LitRelief:
    """Light on heights; `albedo` is the mean of what reflects it."""
    normals = normals_of(height_px, per_px)
    depth = shadow_depth(
        height_px,
        per_px,
        azimuth_rad=light.azimuth_rad,
        elevation_rad=light.elevation_rad,
    )
    sunlit = np.maximum(np.float32(1.0) - depth * np.float32(per_px), np.float32(0.0))
    sun = light.towards_sun()
    direct = np.maximum(normals @ sun, np.float32(0.0)) * sunlit
    direct *= np.float32((1.0 - light.sky) / max(float(sun[2]), _LOW_SUN))
    share = sky_share(height_px, per_px)
    above = np.float32(0.55) + np.float32(0.45) * normals[..., 2]
    ambient = np.float32(light.sky) * cv2.pow(share, _HOLLOW) * above
    bounce = np.float32(_BOUNCE * albedo * (1.0 - 0.5 * light.sky)) * (np.float32(1.0) - share)
    blue = 0.0 if light.overcast else light.warmth
    of_sun = np.array([1.0 + 0.06 * light.warmth, 1.0, 1.0 - 0.12 * light.warmth], np.float32)
    of_sky = np.array([1.0 - 0.12 * blue, 1.0, 1.0 + 0.15 * blue], np.float32)
    arriving = np.stack(
        [(direct + bounce) * one + ambient * two for one, two in zip(of_sun, of_sky, strict=True)],
        axis=-1,
    )
    return LitRelief(normals=normals, sunlit=sunlit, arriving=arriving)
