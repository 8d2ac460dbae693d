"""2-D roughness by size: ripples of graded height, and corners that must not count."""

import numpy as np
from case import Case, Cell, Column, Table
from cases.outlines import pebbles
from numpy.typing import NDArray
from scipy.stats import kendalltau
from silhouettes import REPORTED_FROM, Floats

import rockshape
from synth.shapes.draw import draw_named_series

COUNT = 6  # shapes of a drawing


def roughness_by_size(
    *,
    sizes_px: tuple[int, ...] = (100, 150, 200, 300, 500, 1000),
    drawings: int = 20,
) -> list[Table]:
    """Order, level and share answered of graded ripples; what corners do; pebbles answered."""
    rows: list[tuple[Cell, ...]] = []
    rippled = {size: _read("rippled", size, drawings) for size in sizes_px}
    for size, (heights, found) in rippled.items():
        known = np.isfinite(found)
        both = known & np.isfinite(rippled[sizes_px[-1]][1])
        level = found[both].mean() / rippled[sizes_px[-1]][1][both].mean() if both.any() else None
        graded, corners = _read("rough", size, drawings)
        smooth = _read("roundness", size, drawings)[1]
        rows.append(
            (
                size,
                100 * float(known.mean()),
                _tau(heights, found),
                level,
                100 * float(np.isfinite(corners).mean()),
                _tau(graded, corners),
                float(np.nanmedian(smooth)) if np.isfinite(smooth).any() else None,
            )
        )
    columns = (
        Column("size", "px", "d"),
        Column("ripples: answered", "%", ".0f"),
        Column("τ with their height", "", ".2f"),
        Column("level", "", ".2f"),
        Column("one height, graded roundness: answered", "%", ".0f"),
        Column("τ with the roundness", "", ".2f"),
        Column("smooth: median", "", ".4f"),
    )
    read = np.array([float(rockshape.roughness_2d(mask)) for mask in pebbles()])
    answered = (len(read), int(np.isfinite(read).sum()), float(np.nanmedian(read)))
    real = (Column("pebbles", "", "d"), Column("answered", "", "d"), Column("median", "", ".4f"))
    return [Table(columns, rows, name="drawn"), Table(real, [answered], name="pebbles")]


def _read(series: str, size_px: int, drawings: int) -> tuple[Floats, Floats]:
    """Knobs and roughness of the shapes of so many drawings, (n,) each."""
    knobs, found = [], []
    for seed in range(REPORTED_FROM, REPORTED_FROM + drawings):
        shapes, drawing = draw_named_series(
            series, count=COUNT, seed=seed, size_px=float(size_px), jitter_rms_px=0.0
        )
        for number, shape in enumerate(shapes, start=1):
            knobs.append(shape.knob)
            found.append(float(rockshape.roughness_2d(_window(drawing.labels == number))))
    return np.array(knobs), np.array(found)


def _window(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    cols = np.flatnonzero(mask.any(axis=0))
    return mask[:, max(0, cols[0] - 3) : cols[-1] + 4]


def _tau(knobs: Floats, found: Floats) -> float | None:
    known = np.isfinite(found)
    return float(kendalltau(knobs[known], found[known]).statistic) if known.sum() > 2 else None


ROUGHNESS_2D_CASE = Case(
    name="roughness_2d",
    what="2-D roughness by size: ripples of graded height, corners, pebbles answered",
    run=roughness_by_size,
    smallest={"sizes_px": (200,), "drawings": 1},
)
