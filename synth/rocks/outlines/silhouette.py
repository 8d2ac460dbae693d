"""Outlines of star-shaped bodies from their meshes."""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats, Ints
from synth.geometry.caliper import caliper_half_axes_m
from synth.geometry.mesh import Mesh, half_edges
from synth.rocks.outlines.record import OutlineTruth, polygon_outline
from synth.rocks.outlines.smoothed import SCALE, smoothed_roundness

BEARINGS = 8192  # half as many move every number by less than 1e-3


@dataclass(frozen=True, eq=False)
class MeshForm:
    """Mesh form: a body known by its mesh, ready to be seen from many sides."""

    vertices_m: Floats  # (n, 3)
    faces: Ints  # (m, 3)
    edges: Ints  # (k, 2), vertices
    sides: Ints  # (k, 2), the faces at each edge

    def outline(self, across: Floats) -> OutlineTruth:
        """Outline under parallel rays; see `silhouette`."""
        return self.silhouette(across)

    def caliper_half_axes_m(self) -> Floats:
        """Caliper half-axes L >= I >= S, (3,), of the mesh."""
        return caliper_half_axes_m(self.vertices_m)

    def silhouette(
        self, across: Floats, *, camera_m: float | None = None, bearings: int = BEARINGS
    ) -> OutlineTruth:
        """Outline on the plane through the origin, its rows `across` (2, 3).

        With `camera_m` the rays come from a point at that distance from the origin: what
        perspective makes of the outline. Its roundness is that of the outline smoothed at a
        scale. See `silhouette_points_m`.
        """
        points_m = self.silhouette_points_m(across, camera_m=camera_m, bearings=bearings)
        return polygon_outline(
            points_m, roundness=smoothed_roundness(points_m), roundness_scale=SCALE
        )

    def silhouette_points_m(
        self, across: Floats, *, camera_m: float | None = None, bearings: int = BEARINGS
    ) -> Floats:
        """Points (bearings, 2) of the outline, anticlockwise, at even bearings.

        Where a face turned to the viewer meets one turned away lies an edge that may be on the
        outline; the outline's radius on a bearing from the origin is the farthest such edge's. So
        a notch that cannot be seen from the middle is bridged.
        """
        flat_m = self.vertices_m @ across.T
        if camera_m is not None:
            ahead_m = self.vertices_m @ np.cross(across[0], across[1])
            flat_m = flat_m * (camera_m / (camera_m + ahead_m))[:, None]
        x, y = flat_m[:, 0], flat_m[:, 1]
        one, two, three = self.faces.T
        front = (x[two] - x[one]) * (y[three] - y[one]) > (y[two] - y[one]) * (x[three] - x[one])
        contour = front[self.sides[:, 0]] != front[self.sides[:, 1]]
        radii_m = _farthest_m(flat_m[self.edges[contour]], bearings)
        turn_rad = 2.0 * np.pi * np.arange(bearings) / bearings
        turns = np.column_stack([np.cos(turn_rad), np.sin(turn_rad)])
        return np.asarray(radii_m[:, None] * turns)


def mesh_form(mesh: Mesh) -> MeshForm:
    """Form of a closed mesh: its edges, each with its two faces."""
    faces = mesh.faces
    ends = np.sort(half_edges(faces), axis=1)
    order = np.argsort(ends @ np.array([len(mesh.vertices_m), 1]), kind="stable")
    return MeshForm(
        vertices_m=mesh.vertices_m,
        faces=faces,
        edges=ends[order[::2]],
        sides=(order % len(faces)).reshape(-1, 2),
    )


def _farthest_m(ends_m: Floats, bearings: int) -> Floats:
    """Greatest radius, (bearings,), at which segments (k, 2, 2) cross each bearing."""
    step_rad = 2.0 * np.pi / bearings
    start_rad = np.arctan2(ends_m[:, 0, 1], ends_m[:, 0, 0])
    turn_rad = np.arctan2(ends_m[:, 1, 1], ends_m[:, 1, 0]) - start_rad
    turn_rad = (turn_rad + np.pi) % (2.0 * np.pi) - np.pi
    low_rad = np.minimum(start_rad, start_rad + turn_rad)
    first = np.ceil(low_rad / step_rad).astype(np.int64)
    count = np.floor((low_rad + np.abs(turn_rad)) / step_rad).astype(np.int64) - first + 1
    owner = np.repeat(np.arange(len(ends_m)), count)
    place = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    index = first[owner] + place
    direction = np.column_stack([np.cos(index * step_rad), np.sin(index * step_rad)])
    one, span = ends_m[owner, 0], ends_m[owner, 1] - ends_m[owner, 0]
    # |direction × span| · radius = |one × span|
    above = one[:, 0] * span[:, 1] - one[:, 1] * span[:, 0]
    below = direction[:, 0] * span[:, 1] - direction[:, 1] * span[:, 0]
    radius_m = np.where(np.abs(below) > 1e-15, above / np.where(below == 0.0, 1.0, below), 0.0)
    farthest_m = np.zeros(bearings)
    np.maximum.at(farthest_m, index % bearings, radius_m)
    return farthest_m
