"""Truth of a bed's grains, one row each."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from synth.bed.relief.packing import Grain
from synth.bed.view.whole import WholeOutline

Counts = NDArray[np.int64]
COLUMNS = (
    *("id", "form", "x_px", "y_px", "width_px", "length_px"),
    *("axis_major_px", "axis_minor_px", "orientation_deg", "thickness_px"),
    *("area_px2", "visible_px", "visible_fraction", "truncated"),
)


def grain_table(
    grains: Sequence[Grain],
    outlines: Sequence[WholeOutline],
    visible_px: Counts,
    *,
    shape: tuple[int, int],
) -> pd.DataFrame:
    """Table of the grains in sight; `visible_px` counts their pixels in the tile.

    All but the visible part is of the whole outline's polygon, not of pixels.
    """
    rows = [
        (label, *_row(grain, outline, int(count), shape))
        for label, (grain, outline, count) in enumerate(
            zip(grains, outlines, visible_px, strict=True), start=1
        )
    ]
    table = pd.DataFrame(rows, columns=list(COLUMNS))
    return table.astype({"id": int, "visible_px": int, "truncated": bool})


def _row(
    grain: Grain, outline: WholeOutline, visible_px: int, shape: tuple[int, int]
) -> tuple[str | float | bool, ...]:
    values, vectors = np.linalg.eigh(outline.covariance)
    # A pixel of row r and column c spans half a pixel round (c, r).
    low, high = outline.corners.min(axis=0), outline.corners.max(axis=0)
    truncated = bool((low < -0.5).any() or high[0] > shape[1] - 0.5 or high[1] > shape[0] - 0.5)
    return (
        grain.body.kind,
        float(outline.centroid[0]),
        float(outline.centroid[1]),
        outline.width,
        outline.length,
        float(4.0 * np.sqrt(values[1])),
        float(4.0 * np.sqrt(values[0])),
        float(np.rad2deg(np.arctan2(vectors[1, 1], vectors[0, 1])) % 180.0),
        2.0 * grain.half_thickness_px,
        outline.area,
        visible_px,
        min(visible_px / outline.area, 1.0),
        truncated,
    )
