"""Sizes of a rock's outline: axes, Feret diameters, area, in pixels and in millimetres."""

import math
from dataclasses import dataclass

import numpy as np

from rockshape.outline.descriptors import Descriptors
from rockshape.rock.level_ground import LevelGround
from rockshape.rock.view import RockView

_LENGTHS = ("major_axis", "minor_axis", "feret_max", "feret_min", "equivalent_diameter")
BOX = ("box_row", "box_col")
COLUMNS = (
    *(f"{name}_px" for name in _LENGTHS),
    "outline_area_px2",
    "orientation_deg",
    *BOX,
    "pixel_mm",
    *(f"{name}_mm" for name in _LENGTHS),
    "outline_area_mm2",
)


@dataclass(frozen=True)
class Sizes:
    """Sizes of one outline, px and px², and the side of a pixel on the rock.

    The axes are those of the moment ellipse, from end to end; NaN where the outline has none. A
    pixel's side is NaN where nothing tells the scale.
    """

    major_axis_px: float
    minor_axis_px: float
    feret_max_px: float
    feret_min_px: float
    equivalent_diameter_px: float  # of the circle of equal area
    area_px2: float
    orientation_deg: float  # from x to the major axis, towards y (clockwise as seen), (-90, 90]
    box_row: int  # first row and column of the box round its pixels
    box_col: int
    pixel_m: float

    def row(self) -> tuple[float, ...]:
        """Values in the order of `COLUMNS`."""
        lengths = tuple(float(getattr(self, f"{name}_px")) for name in _LENGTHS)
        pixel_mm = 1e3 * self.pixel_m
        return (
            *lengths,
            self.area_px2,
            self.orientation_deg,
            self.box_row,
            self.box_col,
            pixel_mm,
            *(pixel_mm * length for length in lengths),
            pixel_mm**2 * self.area_px2,
        )


def sizes_of(view: RockView, descriptors: Descriptors, *, pixel_m: float) -> Sizes:
    """Sizes of a rock's outline, of which the descriptors are."""
    ellipse = view.form_ellipse if view.resolved else None
    box_row, box_col = view.corner
    return Sizes(
        major_axis_px=math.nan if ellipse is None else 2 * ellipse.major,
        minor_axis_px=math.nan if ellipse is None else 2 * ellipse.minor,
        feret_max_px=descriptors.feret_max,
        feret_min_px=descriptors.feret_min,
        equivalent_diameter_px=descriptors.equivalent_diameter,
        area_px2=descriptors.area,
        orientation_deg=math.nan if ellipse is None else math.degrees(ellipse.angle_rad),
        box_row=box_row,
        box_col=box_col,
        pixel_m=pixel_m,
    )


def pixel_on_rock_m(
    view: RockView, *, level_ground: LevelGround | None, told_m: float | None
) -> float:
    """Side of a pixel on a rock, m: by range, by level ground at its foot, or as told; else NaN."""
    if view.camera is not None and len(view.points_m):
        return float(np.median(view.points_m[:, 2])) / view.camera.fx
    if view.camera is not None and level_ground is not None:
        foot = view.corner[0] + view.mask.shape[0] - 0.5
        return level_ground.depth_m(foot, view.camera) / view.camera.fx
    return math.nan if told_m is None else told_m
