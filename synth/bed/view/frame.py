"""Orthographic camera that looks obliquely at a bed.

The bed's samples have a row y (towards the camera's foot), a column x and a height h. The view's
rows are v = y cos τ − h sin τ, so that what is nearer lies lower and what is higher lies further
up; columns stay as they are. Of the points on one line of sight, the highest is the nearest.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Singles


@dataclass(frozen=True)
class ObliqueFrame:
    """View's samples, as fine as the bed's."""

    tilt_rad: float  # τ, between the line of sight and the vertical
    per_px: int  # samples in a pixel, along a side
    margin_px: int  # of view and bed round the tile
    offset: float  # row of the view at which row 0 of the bed lies, at height 0
    shape: tuple[int, int]  # of the view, samples

    def rows(self, bed_rows: NDArray[np.floating], height_px: Singles) -> Singles:
        """Rows of the view at which points of the bed lie."""
        drop = np.float32(np.sin(self.tilt_rad) * self.per_px)
        rows = np.float32(np.cos(self.tilt_rad)) * bed_rows - drop * height_px
        return np.asarray(rows + np.float32(self.offset), dtype=np.float32)

    def bed_rows(self, height_px: Singles) -> Singles:
        """Rows of the bed of the points seen, whose heights fill the view."""
        rows = np.arange(len(height_px), dtype=np.float32)[:, None] - np.float32(self.offset)
        drop = np.float32(np.sin(self.tilt_rad) * self.per_px)
        return np.asarray((rows + drop * height_px) / np.float32(np.cos(self.tilt_rad)))

    def towards_px(self, height_px: Singles) -> Singles:
        """Distances towards the camera, px, of the points seen."""
        rows = np.arange(len(height_px), dtype=np.float32)[:, None] / np.float32(self.per_px)
        lifted = height_px + np.float32(np.sin(self.tilt_rad)) * rows
        return np.asarray(lifted / np.float32(np.cos(self.tilt_rad)), dtype=np.float32)

    def to_bed(self, directions: Singles) -> Singles:
        """Directions (…, 3) along the view's columns, rows and line of sight in the bed's axes."""
        cosine, sine = np.float32(np.cos(self.tilt_rad)), np.float32(np.sin(self.tilt_rad))
        right, down, near = (directions[..., axis] for axis in range(3))
        return np.stack([right, cosine * down + sine * near, cosine * near - sine * down], axis=-1)


def bed_rows_needed(rows: int, tilt_rad: float, *, relief_px: float, per_px: int) -> int:
    """Rows of a bed of some relief that fill so many rows of the view."""
    lifted = relief_px * per_px * np.sin(tilt_rad)
    return int(np.ceil((rows + lifted) / np.cos(tilt_rad)))
