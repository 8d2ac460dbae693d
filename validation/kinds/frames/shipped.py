"""Frames that come with the package: lander frames with range, and rocks outlined by hand."""

from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import as_file, files
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

import rockshape
from rockshape import Observation
from rockshape.io import read_labels

_DATA = files("validation") / "kinds" / "frames" / "data"


@dataclass(frozen=True)
class ShippedFrame:
    """A frame of the folder `data`, whose README has its terms."""

    name: str
    figure: int  # of the paper
    rocks: Mapping[str, int]  # number of the outline of each rock that the paper names
    printed: Mapping[str, int]  # row of each in the paper's table 4


FRAMES: Mapping[str, ShippedFrame] = MappingProxyType(
    {
        frame.name: frame
        for frame in (
            ShippedFrame(
                "i925510",
                11,
                {"Flat Top": 1023, "Little Flat Top": 1017, "Stimpy": 1010},
                {"Flat Top": 28, "Little Flat Top": 29, "Stimpy": 30},
            ),
            ShippedFrame(
                "i924795",
                12,
                {"Bamm-Bamm": 1018, "Flute Top": 1004},
                {"Bamm-Bamm": 13, "Flute Top": 14},
            ),
        )
    }
)


def read_frame(name: str) -> tuple[Observation, NDArray[np.int32]]:
    """Observation of a frame, and its rocks outlined by hand as labels (rows, cols)."""
    with (
        as_file(_DATA / f"{name}.png") as image,
        as_file(_DATA / f"{name}_xyz.npz") as points,
        as_file(_DATA / f"{name}_outlines.json") as outlines,
    ):
        frame = rockshape.read(image, range=points)
        rocks = read_labels(outlines, shape=frame.image.shape[:2], image_name=f"{name}_half.png")
    return frame, rocks.to_labels()
