"""Drawing a series as with a pen, all in one row, and writing it with its labels and truth."""

import csv
import io
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from skimage.draw import polygon as polygon_pixels

from synth.errors import InputError
from synth.files import write_png
from synth.shapes.outline import axis_ratio
from synth.shapes.series import Shape, shape_series

Floats = NDArray[np.float64]

_CELL_PX = 260  # a shape's share of the row
_SUBPIXELS = 4
_PAPER, _FILL, _INK = 236, 168, 40  # grey levels
_PEN_WIDTH_PX = 2.5
_JITTER_RMS_PX = 0.35
_JITTER_WAVELENGTH_PX = 60.0
_SHIFT_BITS = 8


@dataclass(frozen=True, eq=False)
class Drawing:
    """A row of shapes; label k + 1 is the k-th of the series."""

    image: NDArray[np.uint8]  # (rows, cols)
    labels: NDArray[np.uint16]  # (rows, cols)
    rows: tuple[dict[str, float], ...]  # the truth of each shape


def draw_series(shapes: list[Shape], *, rng: np.random.Generator) -> Drawing:
    """Return a row of shapes, each drawn with a slightly unsteady pen.

    The pen strays from the exact outline along its normal by a periodic jitter of known RMS and
    least wavelength; the label is what the pen enclosed, pixel centres inside. The truth is the
    exact outline's.
    """
    rows, cols = _CELL_PX, _CELL_PX * len(shapes)
    fine = np.full((rows * _SUBPIXELS, cols * _SUBPIXELS), _PAPER, dtype=np.uint8)
    labels = np.zeros((rows, cols), dtype=np.uint16)
    table = []
    for index, shape in enumerate(shapes):
        exact = shape.outline.outline_px()
        drawn = _unsteady(_evenly_spaced(exact), rng)
        middle = np.array([_CELL_PX * (index + 0.5) - 0.5, _CELL_PX / 2.0 - 0.5])
        pixels = middle + (drawn - (exact.min(axis=0) + exact.max(axis=0)) / 2.0) * [1.0, -1.0]
        inside = polygon_pixels(pixels[:, 1], pixels[:, 0], shape=labels.shape)
        labels[inside] = index + 1
        _ink(fine, pixels)
        table.append(_truth(index, shape))
    blocks = fine.reshape(rows, _SUBPIXELS, cols, _SUBPIXELS).mean(axis=(1, 3))
    return Drawing(image=np.rint(blocks).astype(np.uint8), labels=labels, rows=tuple(table))


def write_series(series: str, out: Path, *, count: int = 4, seed: int = 0) -> None:
    """Write image.png, labels.png and truth.csv of a series into a folder.

    Raises:
        InputError: an unknown series, a count out of range, or a place that is no folder.
    """
    rng = np.random.default_rng([seed])
    drawing = draw_series(shape_series(series, count=count, rng=rng), rng=rng)
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{out}: expected a folder to write to, found {error.strerror}") from error
    write_png(out / "image.png", drawing.image)
    write_png(out / "labels.png", drawing.labels)
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=["rock", "series", *list(drawing.rows[0])[1:]])
    writer.writeheader()
    for row in drawing.rows:
        values = {name: f"{value:.10g}" for name, value in row.items()}
        writer.writerow({**values, "series": series})
    (out / "truth.csv").write_text(text.getvalue(), encoding="utf-8", newline="")


def _truth(index: int, shape: Shape) -> dict[str, float]:
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
        "jitter_rms_px": _JITTER_RMS_PX,
        "jitter_wavelength_px": _JITTER_WAVELENGTH_PX,
    }


def _evenly_spaced(points: Floats) -> Floats:
    """Return a closed outline at steps of half a pixel along its length."""
    closed = np.vstack([points, points[:1]])
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    even = np.arange(0.0, along[-1], 0.5)
    return np.column_stack([np.interp(even, along, closed[:, axis]) for axis in (0, 1)])


def _unsteady(points: Floats, rng: np.random.Generator) -> Floats:
    """Return an outline with the pen's jitter along its normal, of exact RMS."""
    harmonics = max(3, int(0.5 * len(points) / _JITTER_WAVELENGTH_PX))
    turn = 2.0 * np.pi * np.arange(len(points)) / len(points)
    jitter = np.zeros(len(points))
    for harmonic in range(2, harmonics + 1):
        weights = rng.standard_normal(2)
        jitter += weights[0] * np.cos(harmonic * turn) + weights[1] * np.sin(harmonic * turn)
    jitter *= _JITTER_RMS_PX / np.sqrt(np.mean(jitter**2))
    tangent = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    normal = np.column_stack([tangent[:, 1], -tangent[:, 0]])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return points + jitter[:, None] * normal


def _ink(fine: NDArray[np.uint8], pixels: Floats) -> None:
    """Fill a shape and draw its outline into the fine image."""
    subpixels = (pixels + 0.5) * _SUBPIXELS - 0.5
    fixed = np.rint(subpixels * 2**_SHIFT_BITS).astype(np.int32).reshape(-1, 1, 2)
    cv2.fillPoly(fine, [fixed], _FILL, lineType=cv2.LINE_8, shift=_SHIFT_BITS)
    width = round(_PEN_WIDTH_PX * _SUBPIXELS)
    cv2.polylines(
        fine,
        [fixed],
        isClosed=True,
        color=_INK,
        thickness=width,
        lineType=cv2.LINE_8,
        shift=_SHIFT_BITS,
    )
