"""Drawing of shapes as with an unsteady pen: image, labels and truth."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypedDict

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats
from synth.errors import SpecError
from synth.shapes.outline import axis_ratio, polygon_area
from synth.shapes.raster import PAPER, enclosed_pixels, inked_cell
from synth.shapes.roughness import RoughOutline, rough_outline
from synth.shapes.series import shape_series
from synth.shapes.shape import Shape
from synth.spec.shapes import CHART, JITTER_RMS_PX, MAX_JITTER_PX, SIZES_PX

_CELL_PX = 260  # a shape's share of the row, unless its size is given
_ROOM, _ROOM_PX = 1.12, 12  # of a given size's cells: share of the largest extent, and margin
_CHART_COLUMNS = 9
_JITTER_WAVELENGTH_PX = 60.0


@dataclass(frozen=True, eq=False)
class Drawing:
    """Drawing of shapes in rows; label k + 1 is the k-th of the series."""

    image: NDArray[np.uint8]  # (rows, cols)
    labels: NDArray[np.uint16]  # (rows, cols)
    rows: tuple[dict[str, float], ...]  # the truth of each shape
    drawn_px: tuple[Floats, ...]  # what the pen drew, (n, 2) each: column, row
    middles_px: Floats  # (shapes, 2): where each shape's frame has its middle: column, row


def draw_series(
    shapes: list[Shape],
    *,
    rng: np.random.Generator,
    columns: int | None = None,
    jitter_rms_px: float = JITTER_RMS_PX,
    cell_px: int = _CELL_PX,
) -> Drawing:
    """Shapes in rows of so many columns (all in one by default), drawn by unsteady pen.

    The pen strays from the exact outline along its normal by a periodic jitter of known RMS and
    least wavelength; the label is what the pen enclosed, pixel centres inside. The truth is the
    exact outline's.
    """
    across = len(shapes) if columns is None else columns
    rows, cols = cell_px * -(-len(shapes) // across), cell_px * across
    image = np.full((rows, cols), PAPER, dtype=np.uint8)
    labels = np.zeros((rows, cols), dtype=np.uint16)
    table, lines, middles = [], [], []
    for index, shape in enumerate(shapes):
        exact = shape.outline.outline_px()
        line = _evenly_spaced(exact)
        rough = None
        if shape.roughness is not None:
            radius_px = float(np.sqrt(shape.outline.area_px2() / np.pi))
            rough = rough_outline(line, radius_px, shape.roughness, rng)
            line = rough.points_px
        drawn = _unsteady(line, jitter_rms_px, rng)
        row, column = divmod(index, across)
        middle = np.array([cell_px * (column + 0.5) - 0.5, cell_px * (row + 0.5) - 0.5])
        middle -= (exact.min(axis=0) + exact.max(axis=0)) / 2.0 * [1.0, -1.0]
        pixels = middle + drawn * [1.0, -1.0]
        labels[enclosed_pixels(pixels, labels.shape)] = index + 1
        corner = cell_px * np.array([column, row])
        image[corner[1] : corner[1] + cell_px, corner[0] : corner[0] + cell_px] = inked_cell(
            pixels - corner, cell_px
        )
        table.append(_truth(index, shape, jitter_rms_px) | _rough_truth(rough))
        lines.append(pixels)
        middles.append(middle)
    return Drawing(
        image=image,
        labels=labels,
        rows=tuple(table),
        drawn_px=tuple(lines),
        middles_px=np.array(middles),
    )


class DrawingOptions(TypedDict, total=False):
    """Keywords of `draw_named_series`."""

    count: int | None
    knobs: Sequence[float] | None
    seed: int
    jitter_rms_px: float
    size_px: float | None
    turn_deg: float


def draw_named_series(
    series: str,
    *,
    count: int | None = None,
    knobs: Sequence[float] | None = None,
    seed: int = 0,
    jitter_rms_px: float = JITTER_RMS_PX,
    size_px: float | None = None,
    turn_deg: float = 0.0,
) -> tuple[list[Shape], Drawing]:
    """Shapes of a series and their drawing, a function of the arguments alone.

    `size_px` is the long side of every shape's smallest rectangle, before roughness; without it
    the series has its own. `turn_deg` turns the shapes anticlockwise.

    Raises:
        SpecError: an unknown series, or a count, values, jitter, size or turn out of range.
    """
    low_px, high_px = SIZES_PX
    if size_px is not None and not low_px <= size_px <= high_px:
        raise SpecError(f"size_px: expected {low_px:g} to {high_px:g} px, found {size_px:g}")
    if not -360.0 <= turn_deg <= 360.0:
        raise SpecError(f"turn_deg: expected -360 to 360 degrees, found {turn_deg:g}")
    if not 0.0 <= jitter_rms_px <= MAX_JITTER_PX:
        raise SpecError(
            f"jitter_rms_px: expected 0 to {MAX_JITTER_PX:g} px, found {jitter_rms_px:g}"
        )
    rng = np.random.default_rng([seed])
    shapes = shape_series(series, count=count, knobs=knobs, rng=rng)
    shapes = [shape.placed(size_px=size_px, turn_deg=turn_deg) for shape in shapes]
    cell_px = _CELL_PX if size_px is None and turn_deg == 0.0 else _cell_px(shapes)
    columns = _CHART_COLUMNS if series == CHART else None
    drawing = draw_series(
        shapes, rng=rng, columns=columns, jitter_rms_px=jitter_rms_px, cell_px=cell_px
    )
    return shapes, drawing


def _cell_px(shapes: Sequence[Shape]) -> int:
    """Side of a cell that holds each of the shapes."""
    extent_px = max(float(np.ptp(shape.outline.outline_px(), axis=0).max()) for shape in shapes)
    return int(np.ceil(_ROOM * extent_px)) + _ROOM_PX


def _truth(index: int, shape: Shape, jitter_rms_px: float) -> dict[str, float]:
    long_px, short_px = shape.sides_px
    return {
        "rock": index + 1,
        "knob": shape.knob,
        "roundness": shape.outline.roundness(),
        "axis_ratio": axis_ratio(shape.outline.outline_px()),
        "rectangle_ratio": short_px / long_px,
        "area_px2": shape.outline.area_px2(),
        "perimeter_px": shape.outline.perimeter_px(),
        "corner_radius_px": shape.outline.radius_px,
        "jitter_rms_px": jitter_rms_px,
        "jitter_wavelength_px": _JITTER_WAVELENGTH_PX,
    }


def _rough_truth(rough: RoughOutline | None) -> dict[str, float]:
    """Truth of what is laid on the smooth outline, and of the outline under it; before jitter."""
    if rough is None:
        return {}
    following = np.roll(rough.points_px, -1, axis=0)
    return {
        "roughness_rms_px": rough.rms_px,
        "roughness_wavelength_low_px": rough.wavelengths_px[0],
        "roughness_wavelength_high_px": rough.wavelengths_px[1],
        "rough_area_px2": polygon_area(rough.points_px),
        "rough_perimeter_px": float(np.linalg.norm(following - rough.points_px, axis=1).sum()),
        "rough_axis_ratio": axis_ratio(rough.points_px),
    }


def _evenly_spaced(points: Floats) -> Floats:
    """Closed outline at steps of half a pixel along its length."""
    closed = np.vstack([points, points[:1]])
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    even = np.arange(0.0, along[-1], 0.5)
    return np.column_stack([np.interp(even, along, closed[:, axis]) for axis in (0, 1)])


def _unsteady(points: Floats, rms_px: float, rng: np.random.Generator) -> Floats:
    """Outline with the pen's jitter along its normal, of exact RMS."""
    harmonics = max(3, int(0.5 * len(points) / _JITTER_WAVELENGTH_PX))
    turn = 2.0 * np.pi * np.arange(len(points)) / len(points)
    jitter = np.zeros(len(points))
    for harmonic in range(2, harmonics + 1):
        weights = rng.standard_normal(2)
        jitter += weights[0] * np.cos(harmonic * turn) + weights[1] * np.sin(harmonic * turn)
    jitter *= rms_px / np.sqrt(np.mean(jitter**2))
    tangent = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    normal = np.column_stack([tangent[:, 1], -tangent[:, 0]])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return points + jitter[:, None] * normal
