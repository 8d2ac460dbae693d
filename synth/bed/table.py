"""Truth of a bed's grains, one row each."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from synth.bed.relief.packing import Footprint, Grain
from synth.bed.relief.sizes import greatest_caliper

Counts = NDArray[np.int64]
COLUMNS = (
    *("id", "form", "x_px", "y_px", "width_px", "length_px"),
    *("axis_major_px", "axis_minor_px", "orientation_deg", "thickness_px"),
    *("area_px2", "visible_px", "visible_fraction", "truncated"),
)


def grain_table(
    grains: Sequence[Grain],
    places: Sequence[Footprint],
    seen: Counts,
    visible_px: Counts,
    *,
    shape: tuple[int, int],
) -> pd.DataFrame:
    """Table of the grains numbered in `seen`; `visible_px` counts their pixels in the tile.

    All but the visible part is of the whole outline, exactly: from the polygon, not from pixels.
    """
    rows = [
        (label, *_row(grains[index], places[index], int(count), shape))
        for label, (index, count) in enumerate(zip(seen, visible_px, strict=True), start=1)
    ]
    table = pd.DataFrame(rows, columns=list(COLUMNS))
    return table.astype({"id": int, "visible_px": int, "truncated": bool})


def _row(
    grain: Grain, place: Footprint, visible_px: int, shape: tuple[int, int]
) -> tuple[str | float | bool, ...]:
    body, stretch = grain.body, grain.stretch
    area = grain.area_px2
    x, y = place.centre_px + stretch @ body.centroid
    values, vectors = np.linalg.eigh(stretch @ body.covariance @ stretch.T)
    # A pixel of row r and column c spans half a pixel round (c, r).
    corners = body.outline @ stretch.T + place.centre_px
    low, high = corners.min(axis=0), corners.max(axis=0)
    truncated = bool((low < -0.5).any() or high[0] > shape[1] - 0.5 or high[1] > shape[0] - 0.5)
    return (
        body.kind,
        float(x),
        float(y),
        grain.width_px,
        greatest_caliper(body.hull @ stretch.T),
        float(4.0 * np.sqrt(values[1])),
        float(4.0 * np.sqrt(values[0])),
        float(np.rad2deg(np.arctan2(vectors[1, 1], vectors[0, 1])) % 180.0),
        2.0 * grain.half_thickness_px,
        area,
        visible_px,
        min(visible_px / area, 1.0),
        truncated,
    )
