"""Large rasters computed in strips of rows, so that intermediate arrays stay small."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

ROWS = 512


def by_strips(
    apply: Callable[..., NDArray[Any]], *rasters: NDArray[Any], halo: int = 0
) -> NDArray[Any]:
    """What apply makes of rasters (rows, cols, …), of as many rows, a strip of rows at a time.

    Each strip comes with halo rows above and below, as far as there are any, whose results are
    left out: the neighbours that a filter looks at.
    """
    rows = len(rasters[0])
    if rows <= ROWS:
        return apply(*rasters)
    found: NDArray[Any] | None = None
    for top in range(0, rows, ROWS):
        first = max(0, top - halo)
        strips = (raster[first : top + ROWS + halo] for raster in rasters)
        part = apply(*strips)[top - first : top - first + ROWS]
        found = np.empty((rows, *part.shape[1:]), dtype=part.dtype) if found is None else found
        found[top : top + ROWS] = part
    return np.asarray(found)
