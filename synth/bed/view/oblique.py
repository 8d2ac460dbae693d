"""Oblique view: the nearest of ground and grains at each sample, and the light on it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Ints, Singles
from synth.bed.picture.light import BedLight, LitRelief, arriving_light, sunlit_share
from synth.bed.picture.shadows import normals_of, shadow_depth, sky_share
from synth.bed.relief.packing import Footprint, Grain, HeightField
from synth.bed.view.chain import Crossings, crossings, surface_envelope
from synth.bed.view.frame import ObliqueFrame
from synth.bed.view.silhouette import Silhouette, silhouette
from synth.bed.view.whole import WholeOutline, polygon_outline

_UNDER = 0.5  # samples behind the height field's surface at which a point is under an overhang
_SLIVER_PX = 2  # half the width of lit gaps that do not light what lies under an overhang
_LIT = np.float32(-1e6)  # height of the shadow where there is none


@dataclass(frozen=True, eq=False)
class ObliqueView:
    """Packed bed, seen obliquely: grains show their lower sides too."""

    field: HeightField
    frame: ObliqueFrame
    grain: NDArray[np.int32]  # (rows, cols), 0 for the ground, else 1 + the grain's index
    height_px: Singles  # (rows, cols), of the points in sight
    tint: Singles  # (rows, cols), log-brightness of the ground
    under: NDArray[np.bool_]  # (rows, cols), whether the points lie under an overhang
    lit_at: Ints  # (rows, cols), flat indices of the bed's samples with the light on the points
    silhouettes: Sequence[Silhouette]

    def outline(self, index: int) -> WholeOutline:
        """Whole outline of a grain."""
        return polygon_outline(self.silhouettes[index].corners_px)

    def mask(self, index: int) -> tuple[tuple[int, int], NDArray[np.bool_]]:
        """Whole mask of a grain on the view's samples, and the row and column of its first."""
        return self.silhouettes[index].first, self.silhouettes[index].mask

    def shine(self, relief_px: Sequence[Singles], light: BedLight, *, albedo: float) -> LitRelief:
        """Light on the bed with fine relief of the rocks laid over it."""
        per_px, bed = self.field.per_px, self.field.height_px
        depth = shadow_depth(
            bed, per_px, azimuth_rad=light.azimuth_rad, elevation_rad=light.elevation_rad
        )
        shadow = np.where(depth > 0.0, bed + depth, _LIT)
        # Slivers of light in front of an overhang would be drawn out to streaks under it.
        side = 2 * _SLIVER_PX * per_px + 1
        soft = cv2.dilate(shadow, np.ones((1, side), dtype=np.uint8))
        below = np.maximum(self._lit(shadow, soft) - self.height_px, np.float32(0.0))
        sunlit = sunlit_share(below, per_px)
        share = sky_share(bed, per_px)
        sky = self._lit(share, cv2.blur(share, (side, 1)))
        height = self.height_px
        for part in relief_px:
            height = height + part
        normals = normals_of(self.frame.towards_px(height), per_px)
        slopes = self.frame.to_bed(normals)
        arriving = arriving_light(light, slopes, sunlit=sunlit, sky=sky, albedo=albedo)
        up = np.ascontiguousarray(slopes[..., 2])
        return LitRelief(height, normals, up, sunlit, arriving)

    def _lit(self, bed: Singles, evened: NDArray[Any]) -> Singles:
        """Values of the bed's samples for the points in sight, evened out under overhangs."""
        found = bed.ravel()[self.lit_at]
        found[self.under] = evened.ravel()[self.lit_at[self.under]]
        return found


def oblique_view(
    field: HeightField,
    ground_px: Singles,
    tint: Singles,
    *,
    grains: Sequence[Grain],
    places: Sequence[Footprint],
    frame: ObliqueFrame,
) -> ObliqueView:
    """View of a packed bed, its ground with heights and log-brightness like the field.

    Ground and grains are each cut by the lines of sight on their own; the highest point on a line
    is the one that is seen. Light is that on the height field; a point under an overhang gets
    what falls just in front of it.
    """
    height = _surface(ground_px, frame).at(ground_px)
    grain = np.zeros(frame.shape, dtype=np.int32)
    silhouettes = [silhouette(*pair, frame) for pair in zip(grains, places, strict=True)]
    for number, seen in enumerate(silhouettes, start=1):
        (top, left), (rows, columns) = seen.first, seen.mask.shape
        window = (slice(top, top + rows), slice(left, left + columns))
        over = seen.mask & (seen.height_px > height[window])
        height[window][over] = seen.height_px[over]
        grain[window][over] = number
    place = frame.bed_rows(height)
    row = np.asarray(np.rint(place).clip(0, len(tint) - 1), dtype=np.int64)
    met = _surface(field.height_px, frame)
    front = met.link // frame.shape[1]
    under = place < front + met.share - np.float32(_UNDER)
    return ObliqueView(
        field=field,
        frame=frame,
        grain=grain,
        height_px=height,
        tint=np.take_along_axis(tint, row, axis=0),
        under=under,
        lit_at=np.where(under, front + 1, row) * frame.shape[1] + np.arange(frame.shape[1]),
        silhouettes=silhouettes,
    )


def _surface(height_px: Singles, frame: ObliqueFrame) -> Crossings:
    """First points of a height field on the lines of sight."""
    rows = frame.rows(np.arange(len(height_px), dtype=np.float32)[:, None], height_px)
    return crossings(rows, surface_envelope(rows), 0, frame.shape[0])
