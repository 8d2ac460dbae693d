"""Section of a page: one image with its rocks, and what is told of it; kept as JSON in a batch."""

import json
from dataclasses import asdict, dataclass
from typing import Self

from rockshape.measurement import Measurement
from rockshape.report.drawing import MOST_PX, drawing
from rockshape.report.verdict import Tally, tally_of


@dataclass(frozen=True)
class Section:
    """Image of a page: its picture and rocks as the content of an SVG, empty if it is not shown."""

    name: str
    rows: int
    cols: int
    drawing: str
    tally: Tally

    def to_json(self) -> bytes:
        """Section as UTF-8 JSON."""
        return json.dumps(asdict(self)).encode()

    @classmethod
    def from_json(cls, content: bytes) -> Self:
        """Section of `to_json`."""
        told = json.loads(content)
        return cls(**{**told, "tally": Tally(**told["tally"])})


@dataclass(frozen=True)
class SectionOrder:
    """How an image is drawn in a page of many."""

    prefix: str  # of its rocks' keys
    side_px: int  # longer side of its picture; 0: it is counted alone


def section_of(
    name: str, measurement: Measurement, order: SectionOrder = SectionOrder("", MOST_PX)
) -> Section:
    """Section of a measured image."""
    rows, cols = measurement.instances.shape
    drawn = (
        drawing(measurement, prefix=order.prefix, most_px=order.side_px) if order.side_px else ""
    )
    return Section(name, rows, cols, drawn, tally_of(measurement))
