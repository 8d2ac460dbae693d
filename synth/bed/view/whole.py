"""Whole outlines of grains as a camera sees them, whatever lies over them."""

from dataclasses import dataclass

import cv2
import numpy as np

from synth.arrays import Floats
from synth.bed.relief.outline import moments
from synth.bed.relief.packing import Footprint, Grain
from synth.bed.relief.sizes import greatest_caliper, least_caliper


@dataclass(frozen=True, eq=False)
class WholeOutline:
    """Outline in the picture's plane, px: x along columns, y down the rows."""

    corners: Floats  # (n, 2), anticlockwise when y points up
    area: float
    centroid: Floats  # (2,)
    covariance: Floats  # (2, 2), of the area
    width: float  # least caliper
    length: float  # greatest caliper


def plan_outline(grain: Grain, place: Footprint) -> WholeOutline:
    """Outline from straight above, exact."""
    stretch, body = grain.stretch, grain.body
    return WholeOutline(
        corners=body.outline @ stretch.T + place.centre_px,
        area=grain.area_px2,
        centroid=place.centre_px + stretch @ body.centroid,
        covariance=stretch @ body.covariance @ stretch.T,
        width=grain.width_px,
        length=greatest_caliper(body.hull @ stretch.T),
    )


def polygon_outline(corners: Floats) -> WholeOutline:
    """Outline that is a polygon (n, 2)."""
    area, centroid, covariance = moments(corners)
    hull = cv2.convexHull(corners.astype(np.float32))[:, 0].astype(np.float64)
    return WholeOutline(
        corners=corners,
        area=area,
        centroid=centroid,
        covariance=covariance,
        width=least_caliper(hull),
        length=greatest_caliper(hull),
    )
