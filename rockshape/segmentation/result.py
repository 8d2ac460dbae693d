"""Segmentation: the rocks of an observation and how each was found."""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.ground import Ground
from rockshape.rock.instances import Instances
from rockshape.segmentation.edges.edge_snapping import SnappedOutline

Branch = Literal["range", "image", "labels"]


@dataclass(frozen=True, eq=False)
class FoundRock:
    """A rock: what found it, and what its view lacks."""

    number: int  # its instance's id
    branch: Branch
    flags: tuple[str, ...] = ()  # of truncated, occluded, buried, small, shadowed
    outline: SnappedOutline | None = None  # at the image's edge; None: the border of its pixels

    @property
    def outline_sd_px(self) -> float:
        """Standard deviation of its outline; NaN where that is the border of its pixels."""
        return float("nan") if self.outline is None else self.outline.sd_px

    @property
    def is_drawn(self) -> bool:
        """Whether a picture alone has drawn its outline: it is the border of the pixels."""
        return self.branch == "image" and self.outline is None


@dataclass(frozen=True, eq=False)
class Segmentation:
    """The rocks of an observation."""

    instances: Instances
    ground: Ground | None
    frame: tuple[slice, slice]  # rows and columns in which rocks could be found
    found: tuple[FoundRock, ...]  # in the order of the instances

    @cached_property
    def labels(self) -> NDArray[np.int32]:
        """Label image (rows, cols) with each rock's id, 0 the ground."""
        return self.instances.to_labels()


def lacks_range(finder: str) -> InputError:
    """Error for a finder that needs range and has none, which says what can be done."""
    return InputError(
        f"find: {finder!r} expected range to find rocks by (range_m, --range), found none; give "
        "range, or rocks outlined already (labels, --labels), or find them in the image "
        "(find='image', --find image)"
    )
