"""Map frame: where on a map the pixels of an orthophoto lie."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class MapFrame:
    """Affine map from pixels to the coordinates of a reference system.

    matrix (2, 3) takes (x, y, 1), x to the right and y down with pixel centres at whole numbers, to
    map coordinates in the system's order of east and north. epsg is the system's number of the
    EPSG registry; None where the file does not tell it.
    """

    matrix: NDArray[np.float64]
    epsg: int | None

    def place(self, points_px: NDArray[np.float64]) -> NDArray[np.float64]:
        """Map coordinates (n, 2) of points (n, 2)."""
        return np.asarray(points_px @ self.matrix[:, :2].T + self.matrix[:, 2])
