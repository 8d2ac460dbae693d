"""View from straight above: samples of the view are those of the bed."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Singles
from synth.bed.picture.light import BedLight, LitRelief, arriving_light, sunlit_share
from synth.bed.picture.shadows import normals_of, shadow_depth, sky_share
from synth.bed.relief.packing import Footprint, Grain, HeightField
from synth.bed.view.whole import WholeOutline, plan_outline


@dataclass(frozen=True, eq=False)
class ViewFromAbove:
    """Packed bed, seen from straight above."""

    field: HeightField
    tint: Singles  # (rows, cols), log-brightness of the ground
    grains: Sequence[Grain]
    places: Sequence[Footprint]

    @property
    def grain(self) -> NDArray[np.int32]:
        """Grain on top (rows, cols), 0 for the ground, else 1 + the grain's index."""
        return self.field.grain

    def outline(self, index: int) -> WholeOutline:
        """Whole outline of a grain."""
        return plan_outline(self.grains[index], self.places[index])

    def mask(self, index: int) -> tuple[tuple[int, int], NDArray[np.bool_]]:
        """Whole mask of a grain on the view's samples, and the row and column of its first."""
        return self.places[index].first, self.places[index].mask

    def shine(self, relief_px: Sequence[Singles], light: BedLight, *, albedo: float) -> LitRelief:
        """Light on the bed with fine relief of the rocks laid over it."""
        height, per_px = self.field.height_px, self.field.per_px
        for part in relief_px:
            height = height + part
        normals = normals_of(height, per_px)
        depth = shadow_depth(
            height, per_px, azimuth_rad=light.azimuth_rad, elevation_rad=light.elevation_rad
        )
        sunlit = sunlit_share(depth, per_px)
        sky = sky_share(height, per_px)
        arriving = arriving_light(light, normals, sunlit=sunlit, sky=sky, albedo=albedo)
        up = np.ascontiguousarray(normals[..., 2])
        return LitRelief(height, normals, up, sunlit, arriving)
