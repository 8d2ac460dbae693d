"""Rocks made from star-shaped surfaces; their truth is the mesh's."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from synth.arrays import Floats, Ints
from synth.geometry.mesh import Mesh, area_m2, centroid_m
from synth.geometry.min_volume_box import box_along
from synth.rocks.record import RockModel
from synth.rocks.relief import turned_to_box
from synth.rocks.sphere import unit_sphere
from synth.rocks.star.surface import StarSurface, even_points, star_mesh
from synth.rocks.star.touches import SUBDIVISIONS, find_touches

_FITTED_ON = 4  # subdivisions of the sphere on which extents are taken


@dataclass(frozen=True, eq=False)
class Made:
    """What a family makes: a surface, the parameters that it was made from, and its kind."""

    surface: StarSurface
    knobs: Mapping[str, float]
    smooth: bool  # has an area that its meshes converge to
    has_edges: bool  # sharp ones


@dataclass(frozen=True, eq=False)
class _Stretched:
    """Surface stretched along the axes."""

    surface: StarSurface
    factors: Floats  # (3,)

    def points(self, directions: Floats) -> tuple[Floats, Ints]:
        points, parts = self.surface.points(directions)
        return points * self.factors, parts


def fitted(surface: StarSurface, half_axes_m: Floats) -> StarSurface:
    """Surface stretched along the axes until its extents are twice the half-axes (3,)."""
    points, _ = surface.points(unit_sphere(_FITTED_ON)[0])
    return _Stretched(surface, 2.0 * half_axes_m / np.ptp(points, axis=0))


def star_rock(family: str, made: Made, *, longest_m: float, subdivisions: int) -> RockModel:
    """Rock of a surface, scaled alike in all directions until a of its smallest box is given.

    Box and scale are the surface's, whose touches of the box the mesh goes through, so that meshes
    of any fineness have the same. Area is given where the surface is smooth; edges and corners have
    no one radius.
    """
    known = even_points(made.surface, SUBDIVISIONS)
    touches = find_touches(made.surface, known)
    mesh = star_mesh(made.surface, subdivisions, through=touches.directions, known=known)
    turned, axes = turned_to_box(
        family,
        mesh,
        knobs=dict(made.knobs),
        relief_rms_m=0.0,
        degrees=None,
        box=box_along(touches.axes, mesh.vertices_m),
    )
    factor = longest_m / float(turned.truth.half_axes_box_m[0])
    place = _Place(axes=axes, shift=-axes @ centroid_m(mesh), factor=factor)
    scaled = place.moved(mesh)
    truth = turned.truth.scaled(factor, area_m2=area_m2(scaled) if made.smooth else None)
    return replace(
        turned,
        mesh=scaled,
        truth=truth,
        remesh=partial(_remeshed, made.surface, touches.directions, place),
        has_edges=made.has_edges,
        extended=True,
    )


@dataclass(frozen=True, eq=False)
class _Place:
    """Turn, shift and scale from a surface's frame to its rock's."""

    axes: Floats  # (3, 3)
    shift: Floats  # (3,)
    factor: float

    def moved(self, mesh: Mesh) -> Mesh:
        turned = mesh.moved(self.axes, self.shift)
        return replace(turned, vertices_m=self.factor * turned.vertices_m)


def _remeshed(surface: StarSurface, through: Floats, place: _Place, subdivisions: int) -> Mesh:
    return place.moved(star_mesh(surface, subdivisions, through=through))
