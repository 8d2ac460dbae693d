"""Bed: one tile with its picture, labels, heights and the truth of each grain."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from synth.arrays import LabelImage
from synth.handle.html import figure_html

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False, repr=False)
class Bed:
    """Gravel bed seen from straight above, or obliquely from far away.

    Pixel (row, column) stands for the point at its centre: x along columns, y down the rows, both
    in pixels, and heights in the same unit. Labels, heights and normals are those of that point;
    the picture is the mean of what lies round it. Seen with a tilt τ, the point of the bed at
    (x, y) and height h is at column x and row y cos τ − h sin τ, but for a constant.
    """

    image: NDArray[np.uint8]  # (rows, cols, 3): red, green, blue
    labels: LabelImage  # (rows, cols), the value of a grain's `id` in `rocks`, 0 elsewhere
    height_px: NDArray[np.float32]  # (rows, cols), vertical
    normals: NDArray[np.float32]  # (rows, cols, 3): along x, y and towards the camera
    sunlit: NDArray[np.float32]  # (rows, cols), 0 in cast shadow
    albedo: NDArray[np.float32]  # (rows, cols, 3), linear
    rocks: "pd.DataFrame"  # one row a grain in sight
    conditions: Mapping[str, Any]  # what was drawn for this tile: ground, palette, sun …
    seed: int
    index: int  # of the tile in its set
    _masks: tuple[tuple[int, int, NDArray[np.bool_]], ...]  # of the grains, first row and column

    @property
    def tilt_deg(self) -> float:
        """Angle between the line of sight and the vertical; 0 from straight above."""
        return float(self.conditions["tilt_deg"])

    @property
    def depth_px(self) -> NDArray[np.float32]:
        """Distance (rows, cols) along the line of sight, beyond the tile's middle at height 0."""
        tilt, rows = np.deg2rad(self.tilt_deg), len(self.height_px)
        down = (np.arange(rows) - (rows - 1) / 2.0)[:, None]
        return np.asarray(-(self.height_px + np.sin(tilt) * down) / np.cos(tilt), dtype=np.float32)

    def whole_mask(self, label: int) -> NDArray[np.bool_]:
        """Mask (rows, cols) of all that a grain would cover if nothing lay over it.

        Raises:
            KeyError: no grain in sight has that label.
        """
        if not 1 <= label <= len(self._masks):
            raise KeyError(label)
        whole = np.zeros(self.labels.shape, dtype=bool)
        row, column, mask = self._masks[label - 1]
        whole[row : row + mask.shape[0], column : column + mask.shape[1]] = mask
        return whole

    def __repr__(self) -> str:
        """Return size, grains, ground and sun."""
        rows, cols = self.labels.shape
        told = self.conditions
        sky = "overcast" if told["overcast"] else f"sun {told['sun_elevation_deg']:.0f}° high"
        aslant = f"tilted {self.tilt_deg:.0f}°, " if self.tilt_deg > 0.0 else ""
        return (
            f"Bed({self.index}: {rows} × {cols} px, {aslant}{len(self.rocks)} grains on "
            f"{told['ground']}, {told['palette']}, {sky}, seed {self.seed})"
        )

    def _repr_html_(self) -> str:
        """Return the picture, labels as colours and the truth, for a notebook."""
        return figure_html(
            np.ascontiguousarray(self.image[..., ::-1]),
            self.depth_px - self.depth_px.min(),
            caption=repr(self),
            table=self.rocks,
        )
