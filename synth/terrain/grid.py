"""Height grid: a surface over a rectilinear grid, two triangles in each cell."""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats, Ints, Singles
from synth.geometry.mesh import Mesh


@dataclass(frozen=True, eq=False)
class HeightGrid:
    """Heights at the crossings of lines, linear on the triangles between them.

    The mesh is this very surface, so truths that ask for heights agree with what is rendered.
    """

    lines_m: Floats  # (n,), rising, the same along x and y
    height_m: Floats  # (n, n), rows along y

    def heights_m(self, places_m: Floats) -> Floats:
        """Heights at places (..., 2); beyond the grid those of its edge."""
        x_m, y_m = (places_m[..., axis].clip(*self.lines_m[[0, -1]]) for axis in (0, 1))
        column, row = self._cell(x_m), self._cell(y_m)
        u = (x_m - self.lines_m[column]) / (self.lines_m[column + 1] - self.lines_m[column])
        v = (y_m - self.lines_m[row]) / (self.lines_m[row + 1] - self.lines_m[row])
        one, three = self.height_m[row, column], self.height_m[row + 1, column + 1]
        two, four = self.height_m[row, column + 1], self.height_m[row + 1, column]
        below = one + u * (two - one) + v * (three - two)
        above = one + v * (four - one) + u * (three - four)
        return np.asarray(np.where(u >= v, below, above))

    def raised(self, other: "HeightGrid") -> "HeightGrid":
        """Grid with the heights of another over the same lines added."""
        return HeightGrid(self.lines_m, self.height_m + other.height_m)

    def mesh(self) -> Mesh:
        """Surface as triangles, with the normals of the heights' central differences."""
        x_m, y_m = np.meshgrid(self.lines_m, self.lines_m)
        along_y, along_x = np.gradient(self.height_m, self.lines_m, self.lines_m)
        normals = np.stack([-along_x, -along_y, np.ones_like(x_m)], axis=-1).reshape(-1, 3)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        return Mesh(
            vertices_m=np.stack([x_m, y_m, self.height_m], axis=-1).reshape(-1, 3),
            faces=grid_faces(len(self.lines_m)),
            normals=normals,
        )

    def _cell(self, x_m: Floats) -> Ints:
        found = np.searchsorted(self.lines_m, x_m, side="right") - 1
        return np.asarray(found.clip(0, len(self.lines_m) - 2), dtype=np.int64)


def grid_faces(count: int) -> Ints:
    """Triangles of a square grid of count × count vertices, row by row, (m, 3)."""
    corner = np.arange(count * count).reshape(count, count)
    one, two, three, four = (
        part.ravel()
        for part in (corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1])
    )
    return np.concatenate([np.column_stack([one, two, three]), np.column_stack([one, three, four])])


@dataclass(frozen=True)
class Spacing:
    """Spacing of grid lines: even in the field, outside ever wider."""

    half_m: float  # of the field
    cell_m: float  # in the field
    growth: float = 1.05  # of each cell over the one before, outside

    def lines_m(self, end_m: float) -> Floats:
        """Grid lines from about −end_m to end_m, symmetric, (n,)."""
        cells = int(np.ceil(self.half_m / self.cell_m))
        steps_m = [self.cell_m]
        while cells * self.cell_m + sum(steps_m[1:]) < end_m:
            steps_m.append(steps_m[-1] * self.growth)
        outer_m = cells * self.cell_m + np.cumsum(steps_m[1:])
        inner_m = self.cell_m * np.arange(-cells, cells + 1)
        return np.concatenate([-outer_m[::-1], inner_m, outer_m])

    def at(self, x_m: Singles, y_m: Singles) -> Singles:
        """Longer side of the cells at places, (n,)."""
        outside_m = np.maximum(np.maximum(np.abs(x_m), np.abs(y_m)) - self.half_m, 0.0)
        return np.asarray(self.cell_m + (self.growth - 1.0) * outside_m, dtype=np.float32)
