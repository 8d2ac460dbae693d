"""Rough ground put together: its heights as one grid, and the skins of its surfaces."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from synth.arrays import Floats
from synth.geometry.mesh import Mesh
from synth.noise import MipMap
from synth.spec.terrain import TerrainSpec
from synth.terrain.elevation import Elevation, read_elevation
from synth.terrain.grid import HeightGrid, Spacing
from synth.terrain.hills import END_M, Hills, make_hills
from synth.terrain.layers import Layers, make_layers
from synth.terrain.skin import PebbleSkin, Skin, SoilSkin, soil_skin
from synth.terrain.tails import draw_tails

_CELLS = 320  # from the middle to the end of the even part
_LEAST_CELL_M = 0.004
_FAN = 5  # places along a side of the square that a rock's lean is taken from


@dataclass(frozen=True, eq=False)
class RoughGround:
    """Rough ground: a height grid with a skin, and pebbles with another."""

    grid: HeightGrid
    gradient: Floats  # (2,), the mean slope
    radius_m: float  # of the field in which rocks lie
    soil: SoilSkin
    pebble: PebbleSkin
    stones: Mesh | None
    spec: TerrainSpec

    @property
    def haze_m(self) -> float | None:
        """Distance that veils 63 %."""
        return self.spec.haze_m

    @property
    def even(self) -> bool:
        """Whether the ground is its plane: it is not."""
        return False

    @property
    def hiding(self) -> bool:
        """Whether it may hide parts of any rock: it may."""
        return True

    def rise_m(self, meshes: Sequence[Mesh]) -> float:
        """Height above the plane through the origin in the field and round it."""
        near = [
            mesh.vertices_m[np.hypot(*mesh.vertices_m[:, :2].T) <= 2.0 * self.radius_m]
            for mesh in meshes
        ]
        return max(float((vertices_m @ self.normal()).max()) for vertices_m in near)

    @property
    def drop_m(self) -> float:
        """Depth below the plane through the origin, anywhere."""
        along_x, along_y = np.meshgrid(self.grid.lines_m, self.grid.lines_m)
        over_m = self.grid.height_m - self.gradient[0] * along_x - self.gradient[1] * along_y
        return max(0.0, -float(over_m.min()))

    def heights_m(self, places_m: Floats) -> Floats:
        """Heights z at places (..., 2)."""
        return self.grid.heights_m(places_m)

    def foot_m(self, places_m: Floats) -> Floats:
        """Heights at which rocks at places (..., 2) are looked for in views."""
        return self.grid.heights_m(places_m)

    def unevenness_m(self, places_m: Floats) -> Floats:
        """Heights above the plane of the mean slope at places (..., 2)."""
        return np.asarray(self.grid.heights_m(places_m) - places_m @ self.gradient)

    def lean(self, place_m: Floats, reach_m: float) -> Floats:
        """Unit normal (3,) of the plane of least squares through the ground under a rock."""
        side_m = np.linspace(-reach_m, reach_m, _FAN)
        arms_m = np.stack(np.meshgrid(side_m, side_m), axis=-1)
        heights_m = self.grid.heights_m(place_m + arms_m)
        slopes = np.einsum("rc,rck->k", heights_m, arms_m) / (arms_m[..., 0] ** 2).sum()
        normal = np.array([-slopes[0], -slopes[1], 1.0])
        return np.asarray(normal / np.linalg.norm(normal))

    def plane_normal(self) -> Floats | None:
        """Unit normal of the plane that the ground is: there is none."""
        return None

    def normal(self) -> Floats:
        """Unit normal of the mean slope, (3,)."""
        normal = np.array([-self.gradient[0], -self.gradient[1], 1.0])
        return np.asarray(normal / np.linalg.norm(normal))

    def behind(self, meshes: Sequence[Mesh], *, rng: np.random.Generator) -> "RoughGround":
        """Ground with the drifts in the lee of rocks, from which pebbles stick out."""
        tails = draw_tails(self.spec, meshes, self.grid, rng)
        if tails is None:
            return self
        return replace(self, grid=self.grid.raised(tails), soil=replace(self.soil, tails=tails))

    def meshes(self) -> tuple[Mesh, ...]:
        """Surface and pebbles."""
        surface = self.grid.mesh()
        return (surface,) if self.stones is None else (surface, self.stones)

    def skins(self) -> tuple[Skin | None, ...]:
        """Skin of each mesh."""
        soil = Skin(self.soil.reflectance, self.soil.mean_rgb(), self.soil.normals)
        if self.stones is None:
            return (soil,)
        return soil, Skin(self.pebble.reflectance, np.array(self.pebble.pebble))


def rough_heights(
    spec: TerrainSpec,
    *,
    under_m: Callable[[Floats], Floats],
    radius_m: float,
    rng: np.random.Generator,
) -> tuple[HeightGrid, SoilSkin]:
    """Height grid and skin of a ground, fine within a radius of the origin, whose height is 0.

    The relief is added to the heights `under_m` of a slope and ripples, at places (n, 2).

    Raises:
        SpecError: the elevation model cannot be used.
    """
    near, beyond = rng.spawn(2)
    elevation = read_elevation(spec) if spec.elevation else None
    layers = make_layers(spec, near)
    hills = make_hills(spec, radius_m=radius_m, rng=beyond)
    spacing = Spacing(radius_m, max(radius_m / _CELLS, _LEAST_CELL_M))
    lines_m = spacing.lines_m(END_M)
    height_m = _heights_m(lines_m, spacing, layers, hills, elevation)
    height_m += under_m(np.stack(np.meshgrid(lines_m, lines_m), axis=-1))
    origin = HeightGrid(lines_m, height_m).heights_m(np.zeros((1, 2)))
    return HeightGrid(lines_m, height_m - origin), soil_skin(spec, layers, spacing)


def _heights_m(
    lines_m: Floats, spacing: Spacing, layers: Layers, hills: Hills, elevation: Elevation | None
) -> Floats:
    """Heights at the crossings of lines, each the mean over its cell."""
    x_m, y_m = np.meshgrid(lines_m, lines_m)
    places_m = np.stack([x_m, y_m], axis=-1).reshape(-1, 2)
    columns, rows = (places_m / layers.cell_m).astype(np.float32).T
    cells_m = spacing.at(*places_m.astype(np.float32).T)
    relief = MipMap(layers.height_m).at(columns, rows, cells_m / np.float32(layers.cell_m))
    height_m = relief.astype(np.float64) + hills.heights_m(places_m)
    if elevation is not None:
        height_m += elevation.heights_m(places_m)
    return np.asarray(height_m.reshape(x_m.shape))
