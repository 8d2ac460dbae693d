"""Light that bodies give back: of sun and sky, in shadow or not, by their reflectance."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Singles
from synth.light.body import Body
from synth.light.colour import Appearance
from synth.light.fine_relief import FineRelief
from synth.light.mast import MastShadow
from synth.light.photometry import EXPOSURE, light, sun_strength, towards_sun
from synth.light.rays import Surfaces
from synth.light.reflectance import Reflectance
from synth.light.samples import Samples
from synth.light.shade import ShadowMap
from synth.light.wetness import highlight
from synth.spec.surface import SurfaceSpec
from synth.spec.view import SunSpec

Indices = NDArray[np.int64]

_OFF_SURFACE_M = 1.5e-3  # a shadow ray starts this far out, above its own facet's bulge


class Shading:
    """Light of a scene's bodies under its sun and sky."""

    def __init__(
        self,
        rocks: Sequence[Body],
        ground: Sequence[Body],
        sun: SunSpec,
        surface: SurfaceSpec,
        *,
        level: bool,
        appearance: Appearance | None = None,
        things: Sequence[Body] = (),
        mast: MastShadow | None = None,
    ) -> None:
        """Take the bodies, their light and its colours; without colours it is grey.

        `level` tells that the first body of the ground is a plane, which casts no shadow.
        """
        self.surfaces = Surfaces([*rocks, *ground, *things])
        self._mast = mast
        self._sun, self._surface = sun, surface
        self._relief = FineRelief([*rocks, *ground], rocks=len(rocks))
        self._towards_sun = towards_sun(sun).astype(np.float32)
        self._reflectance = Reflectance(
            rocks, ground, surface, things=things, appearance=appearance
        )
        self._wetness = 0.0 if appearance is None else appearance.wetness
        self._sun_colour, self.sky_colour = (
            np.ones((2, 1), dtype=np.float32)
            if appearance is None
            else np.stack([appearance.sun, appearance.sky]).astype(np.float32)
        )
        self.shadow_map = ShadowMap(
            [*rocks, *things] if level else [], ground[1:] if level else [], towards_sun(sun)
        )

    def light_at(self, samples: Samples, eye_m: Singles) -> tuple[Singles, Singles]:
        """Brightness of white at samples, (n,), and the light that they give back, (n, k).

        Relief finer than the triangles is no edge: its body counts as level there, lit or not.
        """
        shaded, shown = self._shaded(samples, eye_m), samples
        sky, direct = self._light(samples, shaded)
        bright = sky + direct
        if self._relief:
            away = np.flatnonzero(samples.normals @ self._towards_sun <= 0.0)
            level = self._light(self._relief.levelled(samples), np.concatenate([shaded, away]))
            bright, shown = level[0] + level[1], self._relief.refined(samples)
            dark = self._relief.dark(samples, away)
            sky, direct = self._light(shown, np.concatenate([shaded, dark]))
        arriving = sky[:, None] * self.sky_colour + direct[:, None] * self._sun_colour
        given_back = np.float32(EXPOSURE) * arriving * self._reflectance.at(samples, shown.normals)
        if self._wetness > 0.0:
            given_back += self._highlights(shown, direct)[:, None] * self._sun_colour
        return bright, given_back

    def _shaded(self, samples: Samples, eye_m: Singles) -> Indices:
        """Samples that a body keeps from the sun, of those turned towards it."""
        if not self._sun.shadows:
            return np.empty(0, dtype=np.int64)
        normals = samples.normals
        incidence = np.asarray(normals @ self._towards_sun)
        tried = np.flatnonzero((incidence > 0.0) & self.shadow_map.possible(samples.points_m))
        starts_m = samples.points_m[tried] + np.float32(_OFF_SURFACE_M) * normals[tried]
        shaded = tried[self.surfaces.blocked(starts_m, self._towards_sun)]
        if self._mast is None:
            return shaded
        incidence[shaded] = 0.0
        lit = np.flatnonzero(incidence > 0.0)
        blocked = self._mast.blocked(samples.points_m[lit], eye_m, self._towards_sun)
        return np.concatenate([shaded, lit[blocked]])

    def _light(self, samples: Samples, shaded: Indices) -> tuple[Singles, Singles]:
        """Light of sky and sun on samples, (n,) each, some of them in shadow."""
        incidence = np.asarray(samples.normals @ self._towards_sun)
        incidence[shaded] = 0.0
        facing = np.einsum("ij,ij->i", samples.directions, samples.normals)
        emission = -facing / np.linalg.norm(samples.directions, axis=1)
        return light(samples.normals[:, 2], incidence, emission, self._sun, self._surface)

    def _highlights(self, samples: Samples, direct: Singles) -> Singles:
        """Sun's highlights in wet surfaces, (n,); none where no sunlight falls."""
        found = np.zeros(len(direct), dtype=np.float32)
        lit = np.flatnonzero(direct > 0.0)
        sights = -samples.directions[lit]
        sights = sights / np.linalg.norm(sights, axis=1, keepdims=True)
        found[lit] = highlight(samples.normals[lit], sights, self._towards_sun)
        return np.float32(self._wetness * sun_strength(self._sun)) * found
