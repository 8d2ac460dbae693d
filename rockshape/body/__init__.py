"""Whole body of a rock seen from one side: its visible surface completed, and its smallest box."""

from rockshape.body.bounding_box import box_half_axes_m
from rockshape.body.completion import completed
from rockshape.body.visible_surface import visible_surface
from rockshape.body.width import greatest_width_m

__all__ = ["box_half_axes_m", "completed", "greatest_width_m", "visible_surface"]
