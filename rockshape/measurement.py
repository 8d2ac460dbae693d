"""What was measured: one record a rock, and the image they are of."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.descriptors import Descriptors
from rockshape.ellipse import Ellipse
from rockshape.ellipsoid import Ellipsoid
from rockshape.measures import Reading

if TYPE_CHECKING:
    import pandas as pd

    from rockshape.ground import Plane
    from rockshape.segmentation import Found


@dataclass(frozen=True, eq=False)
class Rock:
    """One rock's row of the table, with the outline and fits it was measured on."""

    number: int  # the value of its pixels in the label image
    row: float  # centroid of its pixels
    col: float
    area_px: int
    width_px: int
    height_px: int
    truncated: bool  # touches the border of the frame, or of its measured part if found by range
    visible_fraction: float  # of the fitted ellipse, in the frame and not behind a nearer rock
    outline_px: NDArray[np.float64]  # (n, 2) as (x, y)
    ellipse: Ellipse | None
    ellipsoid: Ellipsoid | None
    readings: dict[str, Reading]  # by the measures' columns
    descriptors: Descriptors | None = None  # if they were asked for

    def __post_init__(self) -> None:
        _freeze(self, "outline_px")

    @property
    def values(self) -> dict[str, float]:
        """The value of each measure by its column, NaN where it has none."""
        return {column: reading.value for column, reading in self.readings.items()}

    @property
    def reason(self) -> str:
        """Why values are NaN, each reason said once; empty where none is."""
        reasons = [reading.reason for reading in self.readings.values() if reading.reason]
        return "; ".join(dict.fromkeys(reasons))


@dataclass(frozen=True, eq=False)
class Measurement:
    """What was found in one image."""

    method: str
    labels: NDArray[np.int32]  # (rows, cols), 0 the ground
    ground: "Plane | None"
    rocks: tuple[Rock, ...]  # in the order of their numbers
    found: "tuple[Found, ...]" = ()  # how each was found, likewise; empty with given labels
    described: bool = False  # whether the rocks have descriptors

    def __post_init__(self) -> None:
        _freeze(self, "labels")

    def to_frame(self) -> "pd.DataFrame":
        """The table, one row a rock; its columns are those of `rockshape.table.columns`."""
        from rockshape.table import to_frame  # noqa: PLC0415 - pandas takes as long as all else

        return to_frame(self)


def _freeze(record: Rock | Measurement, name: str) -> None:
    """Have a record hold an array that cannot be written to; the one it was made of still can."""
    view = getattr(record, name).view()
    view.setflags(write=False)
    object.__setattr__(record, name, view)
