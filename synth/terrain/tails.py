"""Drift tails: sand that the wind leaves in the lee of rocks."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats
from synth.geometry.mesh import Mesh
from synth.spec.terrain import TerrainSpec
from synth.terrain.grid import HeightGrid

_STEEPEST = np.tan(np.deg2rad(32.0))  # slope of a tail's sides: dry sand's angle of repose
_HIGHEST = 0.5  # of the rock's height


@dataclass(frozen=True)
class Tail:
    """Drift tail of one rock, in axes along and across the wind from the rock's middle, m.

    With u down the wind and v across it, e the rock's end, L the length beyond it, a the rock's
    half-width and h the crest, the sand is h r(u/e) s (1 − (v/(a s))²) high where that is positive:
    s = 1 − u/(e + L) narrows it to a point, and r(t) = t² (3 − 2t), 1 from t = 1 on, lets it begin
    under the rock.
    """

    middle_m: Floats  # (2,)
    along: Floats  # (2,), unit vector down the wind
    half_width_m: float
    end_m: float
    length_m: float
    crest_m: float

    def heights_m(self, places_m: Floats) -> Floats:
        """Thickness of the sand at places (..., 2)."""
        arms_m = places_m - self.middle_m
        down_m = arms_m @ self.along
        across_m = arms_m @ np.array([-self.along[1], self.along[0]])
        narrowed = 1.0 - down_m / (self.end_m + self.length_m)
        inside = (down_m > 0.0) & (narrowed > 0.0)
        narrowed = np.where(inside, narrowed, 1.0)
        rise = (down_m / self.end_m).clip(0.0, 1.0)
        profile = 1.0 - (across_m / (self.half_width_m * narrowed)) ** 2
        height_m = self.crest_m * rise * rise * (3.0 - 2.0 * rise) * narrowed * profile
        return np.asarray(np.where(inside, np.maximum(height_m, 0.0), 0.0))


def tail_behind(mesh: Mesh, ground: HeightGrid, *, wind_rad: float, lengths: float) -> Tail | None:
    """Tail of a rock on a ground, so many of its widths long; None behind a buried rock.

    The crest is at most half as high as the rock stands above the ground, and at most so high that
    no side is steeper than sand's angle of repose.
    """
    vertices_m = mesh.vertices_m
    above_m = vertices_m[:, 2] - ground.heights_m(vertices_m[:, :2])
    bare_m = vertices_m[above_m > 0.0, :2]
    along = np.array([np.cos(wind_rad), np.sin(wind_rad)])
    axes = np.array([along, [-along[1], along[0]]])
    if not len(bare_m):
        return None
    low_m, high_m = (bare_m @ axes.T).min(axis=0), (bare_m @ axes.T).max(axis=0)
    end_m, half_width_m = (high_m - low_m) / 2.0
    if min(end_m, half_width_m) <= 0.0:
        return None
    return Tail(
        middle_m=(low_m + high_m) / 2.0 @ axes,
        along=along,
        half_width_m=float(half_width_m),
        end_m=float(end_m),
        length_m=float(2.0 * half_width_m * lengths),
        crest_m=float(min(_HIGHEST * above_m.max(), _STEEPEST * half_width_m / 2.0)),
    )


def draw_tails(
    spec: TerrainSpec, meshes: Sequence[Mesh], ground: HeightGrid, rng: np.random.Generator
) -> HeightGrid | None:
    """Thickness of the sand behind rocks on a ground; None without any tails."""
    if spec.tail_length[1] == 0.0:
        return None
    lengths = rng.uniform(*spec.tail_length, size=len(meshes))
    thickness_m = np.zeros_like(ground.height_m)
    for mesh, one in zip(meshes, lengths.tolist(), strict=True):
        tail = tail_behind(mesh, ground, wind_rad=np.deg2rad(spec.wind_deg), lengths=one)
        if tail is not None:
            _lay(thickness_m, tail, ground.lines_m)
    return HeightGrid(ground.lines_m, thickness_m)


def _lay(thickness_m: Floats, tail: Tail, lines_m: Floats) -> None:
    """Lay a tail on a grid, where it is higher than what lies there."""
    reach_m = tail.end_m + tail.length_m + tail.half_width_m
    columns, rows = (
        slice(*np.searchsorted(lines_m, [middle_m - reach_m, middle_m + reach_m]))
        for middle_m in tail.middle_m
    )
    places_m = np.stack(np.meshgrid(lines_m[columns], lines_m[rows]), axis=-1)
    part_m = thickness_m[rows, columns]
    np.maximum(part_m, tail.heights_m(places_m), out=part_m)
