"""Packing of a bed: grains dropped one after another on a height field, each where it rests."""

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats, Singles
from synth.bed.relief.bodies import REACH, SIDE, GrainBody

_SAMPLES = (SIDE - 1) / (2.0 * REACH)  # of a body's maps, in a unit of length
_CANDIDATES = 7  # most places tried for a grain, which rolls to the lowest
_REST = 0.94  # share of the footprint's heights below which a grain rests
_MAX_SLOPE, _FOLLOW = 0.45, 0.75  # a grain leans as its bed does, up to a limit
_MAGNIFIED = 3.0  # maps magnified more than this are enlarged in two steps
_LEVEL = np.zeros(2, dtype=np.float32)
_AROUND = np.array([[0.0, 0.0], [0.55, 0.0], [-0.55, 0.0], [0.0, 0.55], [0.0, -0.55]])


@dataclass(frozen=True, eq=False)
class Grain:
    """Grain to be dropped: body, and how it is drawn out."""

    body: GrainBody
    stretch: Floats  # (2, 2), body to px in plan
    width_px: float  # least caliper of its whole outline
    half_thickness_px: float
    burial: float  # share of its thickness below ground that it lies on

    @property
    def area_px2(self) -> float:
        """Area of the whole outline."""
        (a, b), (c, d) = self.stretch
        return self.body.area * abs(float(a * d - b * c))


@dataclass(frozen=True, eq=False)
class Footprint:
    """Place of a grain in the bed."""

    centre_px: Floats  # (2,), column and row of the body's middle
    base_px: float  # height of its middle
    lean: Singles  # (2,), slopes along columns and rows with which it lies
    first: tuple[int, int]  # row and column of the mask's first sample
    mask: NDArray[np.bool_]  # samples that the whole grain covers, as far as the field goes


@dataclass(eq=False)
class HeightField:
    """Heights of a bed and the grain that is on top, on samples finer than pixels.

    Sample (i, j) lies at row i/per_px − margin_px and column j/per_px − margin_px of the tile.
    """

    height_px: Singles
    grain: NDArray[np.int32]  # 0 for the ground, else 1 + the grain's index
    per_px: int
    margin_px: int

    def samples(self, place_px: Floats) -> Floats:
        """Places in the tile (…, 2) as samples."""
        return (place_px + self.margin_px) * self.per_px


def pack(
    field: HeightField, grains: Sequence[Grain], rng: np.random.Generator
) -> tuple[Footprint, ...]:
    """Grains dropped in turn; the field's heights and grains are changed in place.

    On bare ground a grain stays where it falls. The more of the ground is covered, the more places
    it tries, for on other grains it rolls.
    """
    rows, columns = field.height_px.shape
    span = np.array([columns, rows]) / field.per_px
    draws = rng.uniform(0.0, 1.0, (len(grains), _CANDIDATES, 2))
    placed, covered = [], 0.0
    for number, grain in enumerate(grains, start=1):
        ends = grain.body.hull @ grain.stretch.T
        reach = np.abs(ends).max(axis=0)
        places = draws[number - 1] * (span + 1.2 * reach) - 0.6 * reach - field.margin_px
        tried = places[: 1 + int((_CANDIDATES - 1) * min(covered / float(span.prod()), 1.0))]
        best = tried[np.argmin(_levels(field, tried, reach))]
        covered += grain.area_px2
        placed.append(_drop(field, number, grain, best, ends))
    return tuple(placed)


def _levels(field: HeightField, places_px: Floats, reach_px: Floats) -> Floats:
    """Mean height round each place, (n,)."""
    points = field.samples(places_px[:, None, :] + _AROUND * reach_px).astype(np.int64)
    rows = points[..., 1].clip(0, field.height_px.shape[0] - 1)
    columns = points[..., 0].clip(0, field.height_px.shape[1] - 1)
    return np.asarray(field.height_px[rows, columns].mean(axis=1), dtype=np.float64)


def _drop(
    field: HeightField, number: int, grain: Grain, centre_px: Floats, ends_px: Floats
) -> Footprint:
    middle = field.samples(centre_px)
    shape = field.height_px.shape
    left, top, right, bottom = window_of(ends_px, middle, field.per_px)
    left, top = max(left, 0), max(top, 0)
    right, bottom = min(right, shape[1]), min(bottom, shape[0])
    if left >= right or top >= bottom:
        return Footprint(centre_px, 0.0, _LEVEL, (0, 0), np.zeros((0, 0), dtype=bool))
    maps = cut_maps(grain, middle, field.per_px, left=left, top=top, right=right, bottom=bottom)
    inside = maps[..., 0] < 1.0
    if not inside.any():
        return Footprint(centre_px, 0.0, _LEVEL, (top, left), inside)
    root = np.sqrt(np.maximum(1.0 - maps[..., 0], 0.0))
    root *= np.float32(grain.half_thickness_px)
    above, below = maps[..., 1] * root, maps[..., 2] * root
    window = (slice(top, bottom), slice(left, right))
    bed, owner = field.height_px[window], field.grain[window]
    step = np.float32(1.0 / field.per_px)
    across = (np.arange(left, right, dtype=np.float32) - np.float32(middle[0])) * step
    down = (np.arange(top, bottom, dtype=np.float32) - np.float32(middle[1])) * step
    lean = _lean(bed, inside, across, down)
    slant = lean[0] * across[None, :] + lean[1] * down[:, None]
    gaps = (bed + below - slant)[inside]
    rest = float(np.partition(gaps, int(_REST * (len(gaps) - 1)))[int(_REST * (len(gaps) - 1))])
    on_ground = float((owner[inside] == 0).mean())
    base = rest - 2.0 * grain.half_thickness_px * grain.burial * on_ground**2
    surface = above + slant + np.float32(base)
    seen = inside & (surface > bed)
    bed[seen] = surface[seen]
    owner[seen] = number
    return Footprint(centre_px, base, lean, (top, left), inside)


def window_of(ends_px: Floats, middle: Floats, per_px: int) -> tuple[int, int, int, int]:
    """Samples round a grain: left, top, right and bottom, the latter two excluded.

    `ends_px` (n, 2) are corners of its outline about its middle, which is given in samples.
    """
    low = np.floor(middle + per_px * ends_px.min(axis=0)).astype(int) - 1
    high = np.ceil(middle + per_px * ends_px.max(axis=0)).astype(int) + 2
    return int(low[0]), int(low[1]), int(high[0]), int(high[1])


def cut_maps(
    grain: Grain, middle: Floats, per_px: int, *, left: int, top: int, right: int, bottom: int
) -> Singles:
    """Body's maps over a window of the field, (rows, columns, 3)."""
    inverse = np.linalg.inv(per_px * grain.stretch) * _SAMPLES
    magnified = 1.0 / float(np.abs(inverse).max())
    coarse = max(1, int(magnified / _MAGNIFIED + 0.5))
    start = np.array([left, top]) + (coarse - 1) / 2.0 - middle
    matrix = np.empty((2, 3))
    matrix[:, :2] = inverse * coarse
    matrix[:, 2] = inverse @ start + REACH * _SAMPLES
    size = (-(-(right - left) // coarse), -(-(bottom - top) // coarse))
    maps = cv2.warpAffine(
        grain.body.maps,
        matrix,
        size,
        flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
        borderMode=cv2.BORDER_CONSTANT,
        borderValue=(4.0, 0.0, 0.0, 0.0),
    )
    if coarse > 1:
        whole = (size[0] * coarse, size[1] * coarse)
        maps = cv2.resize(maps, whole, interpolation=cv2.INTER_CUBIC)
        maps = maps[: bottom - top, : right - left]
    return np.asarray(maps, dtype=np.float32)


def _lean(
    bed: Singles, inside: NDArray[np.bool_], across: Singles, down: Singles
) -> NDArray[np.float32]:
    """Slopes along columns and rows with which a grain lies on its bed, (2,)."""
    step = max(1, min(bed.shape) // 12)
    weight = inside[::step, ::step].astype(np.float32)
    x, y = across[None, ::step], down[::step, None]
    total = float(weight.sum())
    if total < 6:
        return np.zeros(2, dtype=np.float32)
    level = weight * (bed[::step, ::step] - np.float32(bed[inside].mean()))
    x = x - (weight * x).sum() / total
    y = y - (weight * y).sum() / total
    xx, yy, xy = ((weight * p).sum() for p in (x * x, y * y, x * y))
    xh, yh = (level * x).sum(), (level * y).sum()
    det = xx * yy - xy * xy
    if det <= 1e-6 * xx * yy:
        return np.zeros(2, dtype=np.float32)
    slope = np.array([yy * xh - xy * yh, xx * yh - xy * xh]) / det * _FOLLOW
    steep = float(np.hypot(*slope))
    return np.asarray(slope * min(1.0, _MAX_SLOPE / max(steep, 1e-9)), dtype=np.float32)
