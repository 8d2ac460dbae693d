"""Plain ground: a plane with a slope, sand ripples and pebbles."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats
from synth.geometry.mesh import Mesh, vertex_normals
from synth.spec.ground import GroundSpec
from synth.terrain.grid import grid_faces
from synth.terrain.skin import Skin

HALF_SIDE_M = 150.0
_CELLS_PER_RIPPLE = 10
_MAX_CELLS = 700  # along a side of the rippled part
_GROWTH = 1.25  # of the cells outside of it
_WANDER = 0.6  # how far crests stray from straight lines, in ripple lengths
_SECOND = 0.2  # amplitude of the second harmonic, which sharpens the crests


@dataclass(frozen=True, eq=False)
class Terrain:
    """Height field z = g·(x, y), and ripples that fade out beyond a radius."""

    gradient: Floats  # (2,), the slope
    ripple_height_m: float
    wave_per_m: Floats  # (2,), radians per metre across the crests
    bends: Floats  # (n, 4): amplitude (rad), waves along x and y (rad/m), phase (rad)
    radius_m: float
    stones: Mesh | None

    @property
    def even(self) -> bool:
        """Whether there are no ripples."""
        return self.ripple_height_m == 0.0

    def rise_m(self, meshes: Sequence[Mesh]) -> float:
        """Height of ripples and pebbles above the plane."""
        up = self.normal()
        return max(float((mesh.vertices_m @ up).max()) for mesh in meshes)

    @property
    def drop_m(self) -> float:
        """Depth below the plane: that of ripples is small beside the slack of the limits."""
        return 0.0

    @property
    def hiding(self) -> bool:
        """Whether it hides parts of rocks: the silhouette of a free rock ends at the plane."""
        return False

    @property
    def haze_m(self) -> float | None:
        """Distance that veils: the air is clear."""
        return None

    def heights_m(self, places_m: Floats) -> Floats:
        """Heights z at places (..., 2)."""
        return np.asarray(places_m @ self.gradient + self.unevenness_m(places_m))

    def foot_m(self, places_m: Floats) -> Floats:
        """Heights of the plane at places (..., 2)."""
        return np.asarray(places_m @ self.gradient)

    def lean(self, place_m: Floats, reach_m: float) -> Floats | None:  # noqa: ARG002
        """Normal that rocks lean along: that of the slope."""
        return None

    def unevenness_m(self, places_m: Floats) -> Floats:
        """Ripple heights at places (..., 2), half their height to both sides of the plane."""
        if self.ripple_height_m == 0.0:
            return np.zeros(places_m.shape[:-1])
        phase = places_m @ self.wave_per_m
        for amplitude, across, along, start in self.bends:
            phase = phase + amplitude * np.sin(places_m @ np.array([across, along]) + start)
        fade = np.exp(-(((places_m**2).sum(axis=-1) / self.radius_m**2) ** 3))
        shape = np.cos(phase) + _SECOND * np.cos(2.0 * phase)
        return np.asarray(self.ripple_height_m / 2.0 * fade * shape)

    def plane_normal(self) -> Floats | None:
        """Unit normal, (3,), where the ground is a plane through the origin."""
        return self.normal() if self.even else None

    def normal(self) -> Floats:
        """Slope's unit normal, (3,)."""
        normal = np.array([-self.gradient[0], -self.gradient[1], 1.0])
        return np.asarray(normal / np.linalg.norm(normal))

    def behind(self, meshes: Sequence[Mesh], *, rng: np.random.Generator) -> "Terrain":  # noqa: ARG002
        """Ground with what the wind leaves behind rocks: no wind blows here."""
        return self

    def meshes(self) -> tuple[Mesh, ...]:
        """Surface, two triangles if it is a plane, and the pebbles."""
        lines_m = self._grid_lines_m()
        places_m = np.stack(np.meshgrid(lines_m, lines_m), axis=-1).reshape(-1, 2)
        vertices_m = np.column_stack([places_m, self.heights_m(places_m)])
        faces = grid_faces(len(lines_m))
        surface = Mesh(
            vertices_m=vertices_m, faces=faces, normals=vertex_normals(vertices_m, faces)
        )
        return (surface,) if self.stones is None else (surface, self.stones)

    def skins(self) -> tuple[Skin | None, ...]:
        """Skins of surface and pebbles: none."""
        return (None,) if self.stones is None else (None, None)

    def _grid_lines_m(self) -> Floats:
        """Grid lines of the mesh: evenly over the ripples, ever farther outside."""
        if self.ripple_height_m == 0.0:
            return np.array([-HALF_SIDE_M, HALF_SIDE_M])
        rippled_m = 1.4 * self.radius_m
        wanted_m = 2.0 * np.pi / float(np.linalg.norm(self.wave_per_m)) / _CELLS_PER_RIPPLE
        cells = min(_MAX_CELLS, int(np.ceil(2.0 * rippled_m / wanted_m)))
        inner_m = np.linspace(-rippled_m, rippled_m, cells + 1)
        steps = int(np.ceil(np.log(HALF_SIDE_M / rippled_m) / np.log(_GROWTH)))
        outer_m = np.geomspace(rippled_m, HALF_SIDE_M, max(steps, 1) + 1)[1:]
        return np.concatenate([-outer_m[::-1], inner_m, outer_m])


def bare_ground(spec: GroundSpec, *, radius_m: float, rng: np.random.Generator) -> Terrain:
    """Plane with its slope and ripples."""
    azimuth_rad = np.deg2rad(spec.slope_azimuth_deg)
    rise = np.tan(np.deg2rad(spec.slope_deg))
    gradient = rise * np.array([np.cos(azimuth_rad), np.sin(azimuth_rad)])
    across_rad = np.deg2rad(spec.ripple_azimuth_deg)
    wave = 2.0 * np.pi / spec.ripple_length_m
    bends = np.array(
        [
            [
                2.0 * np.pi * _WANDER / order * rng.uniform(0.5, 1.0),
                wave * order / 6.0 * rng.uniform(-1.0, 1.0),
                wave * order / 6.0 * rng.uniform(-1.0, 1.0),
                rng.uniform(0.0, 2.0 * np.pi),
            ]
            for order in (1.0, 1.7, 2.9)
        ]
    )
    return Terrain(
        gradient=gradient,
        ripple_height_m=spec.ripple_height_m,
        wave_per_m=wave * np.array([np.cos(across_rad), np.sin(across_rad)]),
        bends=bends,
        radius_m=radius_m,
        stones=None,
    )
