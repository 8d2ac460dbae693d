"""Drawn shapes in the plane, in series, with the exact truth of each outline."""

from synth.shapes.draw import draw_series
from synth.shapes.series import SERIES, shape_series
from synth.shapes.shape import Shape
from synth.shapes.write import write_series

__all__ = ["SERIES", "Shape", "draw_series", "shape_series", "write_series"]
