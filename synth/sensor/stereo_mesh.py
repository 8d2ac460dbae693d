"""Coarse stereo mesh: a few hundred triangles through noisy stereo points, as products have."""

from typing import Annotated, Literal

import numpy as np
from msgspec import Meta, Struct
from scipy.ndimage import binary_fill_holes

from synth.arrays import Floats
from synth.camera.lens import undistorted
from synth.camera.projection import pixel_rays
from synth.sensor.sensor import Capture, Sensor, SensorInput
from synth.sensor.stereo import stereo_depth_m
from synth.sensor.triangulation import adaptive_vertices, mesh_values, regular_vertices


class MeshOptions(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Stereo mesh. The points are those of `stereo`, with its keys of [noise]."""

    triangles: Annotated[int, Meta(ge=2, le=100_000)] = 500  # of a frame, about
    layout: Literal["adaptive", "regular"] = "adaptive"  # finer where the surface bends, or even
    vertex_px: Annotated[int, Meta(ge=1, le=64)] = 8  # vertices lie on pixels so far apart


def meshed_depth_m(depth_m: Floats, rays: Floats, options: MeshOptions) -> Floats:
    """Z-depth, (rows, cols), of a mesh through some of the points; NaN outside.

    `rays` (rows, cols, 2) are x/z and y/z of the pixels. 1/z is linear in them on a plane, so that
    a triangle's inner pixels are those of the flat facet between its corners. A corner lies on its
    pixel's ray, so facets hide one another nowhere. Holes are closed, but for those that reach the
    frame's border, as the sky does: a facet that lies in one by more than half is left out.
    """
    inverse = 1.0 / depth_m
    chosen = np.zeros(depth_m.shape, dtype=bool)
    offset = [(side % options.vertex_px) // 2 for side in depth_m.shape]
    chosen[offset[0] :: options.vertex_px, offset[1] :: options.vertex_px] = True
    chosen &= np.isfinite(inverse)
    points, values = rays[chosen], inverse[chosen]
    vertices = {"adaptive": adaptive_vertices, "regular": regular_vertices}[options.layout]
    corners = vertices(points, values, options.triangles)
    found = mesh_values(
        points[corners], values[corners], rays, binary_fill_holes(np.isfinite(inverse))
    )
    return np.asarray(1.0 / found)


def _capture(shot: SensorInput) -> Capture:
    across, down = undistorted(shot.camera, *np.broadcast_arrays(*pixel_rays(shot.camera)))
    rays = np.stack([across, down], axis=-1).astype(np.float64)
    return Capture(
        picture=shot.picture, depth_m=meshed_depth_m(stereo_depth_m(shot), rays, shot.options)
    )


MESH = Sensor(
    "mesh",
    "a coarse mesh through the points of a stereo camera",
    _capture,
    needs_baseline=True,
    options=MeshOptions,
)
