"""Where the rocks are: the published way, by heights alone, and a robust one by range and image."""

from rockshape.segmentation.edges.edge_snapping import SnappedOutline
from rockshape.segmentation.result import Branch, FoundRock, Segmentation, Variant
from rockshape.segmentation.robust import ground_under, segment

__all__ = [
    "Branch",
    "FoundRock",
    "Segmentation",
    "SnappedOutline",
    "Variant",
    "ground_under",
    "segment",
]
