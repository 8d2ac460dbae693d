"""What a segmentation tells of each rock beside its pixels."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rockshape.ground import Ground
from rockshape.segmentation.edges.edge_snapping import SnappedOutline

Branch = Literal["range", "image", "labels"]
Variant = Literal["paper", "robust"]


@dataclass(frozen=True, eq=False)
class FoundRock:
    """A rock: what found it, and what its view lacks."""

    number: int  # the value of its pixels in the label image
    branch: Branch
    flags: tuple[str, ...] = ()  # of truncated, occluded, buried, small, shadowed
    outline: SnappedOutline | None = None  # at the image's edge; None: the border of its pixels


@dataclass(frozen=True, eq=False)
class Segmentation:
    """Where the rocks of an observation are."""

    labels: NDArray[np.int32]  # (rows, cols), 0 the ground
    ground: Ground | None
    frame: tuple[slice, slice]  # rows and columns in which rocks could be found
    found: tuple[FoundRock, ...]  # in the order of their numbers
