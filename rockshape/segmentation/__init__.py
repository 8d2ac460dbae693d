"""Where the rocks are: the published way, by heights alone, and a robust one by range and image."""

from rockshape.segmentation.found import Branch, Found, Segmentation, Variant
from rockshape.segmentation.segment import ground_under, segment
from rockshape.segmentation.snap import Outline

__all__ = ["Branch", "Found", "Outline", "Segmentation", "Variant", "ground_under", "segment"]
