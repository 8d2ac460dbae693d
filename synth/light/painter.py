"""Deferred shading: one image from the depth and labels of any backend.

A backend tells what each pixel shows and how far it is; the light there is worked out here, once
for all backends, so their images differ no more than their geometry does.
"""

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats, Singles
from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.light.air import Air
from synth.light.body import Body
from synth.light.colour import Appearance
from synth.light.mast import MastShadow
from synth.light.photometry import SKY
from synth.light.rays import Surfaces, directions
from synth.light.samples import Samples, stretch, width_m
from synth.light.shading import Shading
from synth.spec.surface import SurfaceSpec
from synth.spec.view import SunSpec

Indices = NDArray[np.int64]

_ON_PLANE = 3e-4  # of the depth: farther from the plane than this, a point is on something else
_EDGE = 12.0 / 255.0  # more contrast than this between neighbours is an edge
_AT_ONCE = 1 << 17  # samples; eight times as many leave the cache and take longer


class Painter:
    """Deferred shading of a scene's bodies."""

    def __init__(
        self,
        rocks: Sequence[Body],
        ground: Sequence[Body],
        plane_normal: Floats | None,
        sun: SunSpec,
        surface: SurfaceSpec,
        *,
        appearance: Appearance | None = None,
        things: Sequence[Body] = (),
        mast: MastShadow | None = None,
        haze_m: float | None = None,
    ) -> None:
        """Take the bodies, their light and its colours; without colours it paints grey."""
        self._rocks = len(rocks)
        self._plain = len(ground) == 1
        self._plane = None if plane_normal is None else plane_normal.astype(np.float32)
        self.shading = Shading(
            rocks,
            ground,
            sun,
            surface,
            level=plane_normal is not None,
            appearance=appearance,
            things=things,
            mast=mast,
        )
        self._air = Air(self.shading.sky_colour, sun.ambient, haze_m)

    @property
    def surfaces(self) -> Surfaces:
        """Surfaces that rays meet."""
        return self.shading.surfaces

    def paint(
        self,
        camera: RenderCamera,
        pose: Pose,
        labels: NDArray[np.uint16],
        depth_m: Floats,
        *,
        supersample: int,
    ) -> Singles:
        """Linear light, (rows, cols, k), 1 for white; what is brighter is more.

        k = 3 for red, green and blue, 1 for grey.

        Each pixel is shaded at its centre, its texture averaged over it. Where the light jumps,
        at outlines, shadows and edges, a pixel is the mean of supersample² samples instead.
        """
        bright = np.empty(depth_m.shape, dtype=np.float32)
        value = np.empty((*depth_m.shape, self.channels), dtype=np.float32)
        step = max(1, _AT_ONCE // camera.width)
        for start in range(0, camera.height, step):
            band = slice(start, start + step)
            bright[band], value[band] = self._centres(
                camera, pose, labels[band], depth_m[band], start
            )
        if supersample > 1:
            edges = np.flatnonzero(_jumps(bright, labels))
            parts = -(-len(edges) * supersample**2 // _AT_ONCE)  # none without an edge
            for part in np.array_split(edges, parts) if parts else ():
                refined = self._refined(camera, pose, part, supersample)
                value.reshape(-1, self.channels)[part] = refined
        return value

    @property
    def channels(self) -> int:
        """The number of channels of the light: 3 in colour, 1 in grey."""
        return len(self.shading.sky_colour)

    def _centres(
        self,
        camera: RenderCamera,
        pose: Pose,
        labels: NDArray[np.uint16],
        depth_m: Floats,
        first_row: int,
    ) -> tuple[Singles, Singles]:
        """Brightness of white and the light of whole rows, sampled at the pixels' centres."""
        rows = np.arange(first_row, first_row + len(depth_m), dtype=np.float32)[:, None]
        columns = np.arange(camera.width, dtype=np.float32)[None, :]
        rays = directions(camera, pose, columns, rows).reshape(-1, 3)
        eye_m = pose.position_m().astype(np.float32)
        depth = depth_m.astype(np.float32).ravel()
        points_m = rays * depth[:, None] + eye_m
        bright, value = np.full(len(rays), np.float32(SKY)), self._air.sky(rays)
        there = ~np.isnan(depth)
        flat = self._on_plane(points_m, depth) & (labels.ravel() == 0) & there
        here = np.flatnonzero(flat)
        if self._plane is not None and len(here):
            samples = Samples(
                points_m=points_m[here],
                normals=np.broadcast_to(self._plane, (len(here), 3)),
                body=np.full(len(here), self._rocks),
                directions=rays[here],
                width_m=width_m(camera, depth[here]),
                stretch=stretch(rays[here] @ self._plane),
            )
            bright[here], value[here] = self.shading.light_at(samples, eye_m)
        rest = np.flatnonzero(there & ~flat)
        bright[rest], value[rest] = self._seen(camera, eye_m, rays[rest], 1)
        return bright.reshape(depth_m.shape), value.reshape(*depth_m.shape, self.channels)

    def _on_plane(self, points_m: Singles, depth: Singles) -> NDArray[np.bool_]:
        if self._plane is None:
            return np.zeros(len(points_m), dtype=bool)
        if self._plain:
            return np.ones(len(points_m), dtype=bool)
        return np.asarray(np.abs(points_m @ self._plane) < _ON_PLANE * depth)

    def _refined(self, camera: RenderCamera, pose: Pose, pixels: Indices, factor: int) -> Singles:
        """Light of single pixels, (n, k), each the mean of factor² samples."""
        rows, columns = np.divmod(pixels, camera.width)
        offsets = (np.arange(factor, dtype=np.float32) + 0.5) / factor - 0.5
        down, across = (offset.ravel() for offset in np.meshgrid(offsets, offsets, indexing="ij"))
        rays = directions(
            camera,
            pose,
            (columns[:, None] + across).astype(np.float32),
            (rows[:, None] + down).astype(np.float32),
        )
        eye_m = pose.position_m().astype(np.float32)
        _, value = self._seen(camera, eye_m, rays.reshape(-1, 3), factor)
        clipped = np.clip(value.T, 0.0, 1.0).reshape(self.channels, len(pixels), -1)
        return np.asarray(clipped.mean(axis=2).T)

    def _seen(
        self, camera: RenderCamera, eye_m: Singles, rays: Singles, factor: int
    ) -> tuple[Singles, Singles]:
        """Brightness of white and the light at the end of rays from the eye."""
        bright, value = np.full(len(rays), np.float32(SKY)), self._air.sky(rays)
        hits = self.surfaces.trace(np.broadcast_to(eye_m, rays.shape).copy(), rays)
        here = np.flatnonzero(hits.body >= 0)
        if not len(here):
            return bright, value
        normals = self.surfaces.normals_at(hits, here)
        facing = np.einsum("ij,ij->i", rays[here], normals)
        samples = Samples(
            points_m=rays[here] * hits.length[here, None] + eye_m,
            normals=normals,
            body=hits.body[here],
            directions=rays[here],
            width_m=width_m(camera, hits.length[here]) / np.float32(factor),
            stretch=stretch(facing),
        )
        bright[here], value[here] = self.shading.light_at(samples, eye_m)
        distance_m = hits.length[here] * np.linalg.norm(rays[here], axis=1)
        value[here] = self._air.veiled(value[here], distance_m)
        return bright, value


def _jumps(bright: Singles, labels: NDArray[np.uint16]) -> NDArray[np.bool_]:
    """Mask of pixels that differ clearly from a neighbour, in light or in label."""
    box = np.ones((3, 3), dtype=np.uint8)
    spread = cv2.dilate(bright, box) - cv2.erode(bright, box)
    apart = cv2.dilate(labels, box) != cv2.erode(labels, box)
    return np.asarray((spread > _EDGE) | apart)
