"""Position tables of the Mars Pathfinder lander camera (IMP)."""

import re
from typing import TYPE_CHECKING

import numpy as np

from rockshape.errors import InputError
from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

COLUMNS = 5  # line, sample, x, y, z; a pixel value can follow
_NUMBER = rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_ROW = re.compile(rb"^\s*\d+\s*[,\s]\s*\d+(\s*[,\s]\s*" + _NUMBER + rb"){3,4}\s*,?\s*$")


def read_imp_table(file: "InputFile", info: ImageInfo) -> RangeRaster:
    """Points (rows, cols, 3), m, in the lander's frame; pixels without a row have none.

    Lines and samples count from 1, or from 0 where one of them is 0.
    Raises: InputError for pixels outside the image, and such as are listed twice.
    Source: PDS data set MPFL-M-IMP-5-3DPOSITION-V1.0.
    """
    if not file.data.endswith((b"\n", b"\r")):
        raise file.refusal("a last row without an end of line, which may be cut")
    lines = [line for line in file.data.splitlines() if _ROW.match(line)]
    if not lines:
        raise file.refusal("no rows of line, sample, x, y, z")
    table = np.array([line.replace(b",", b" ").split()[:COLUMNS] for line in lines], dtype=float)
    place = table[:, :2].astype(np.int64)
    place -= 0 if (place == 0).any() else 1
    if (place >= info.shape).any():
        line, sample = table[(place >= info.shape).any(axis=1)][0, :2]
        raise InputError(
            f"{file.path}: expected pixels of the image {info.shape}, found line {line:g}, "
            f"sample {sample:g}"
        )
    points = np.full((*info.shape, 3), np.nan)
    points[tuple(place.T)] = table[:, 2:]
    if len(np.unique(place, axis=0)) != len(place):
        raise file.refusal("a pixel that is listed twice")
    return RangeRaster(points)


def _is_table(head: bytes) -> bool:
    """Whether the first lines after a PDS label, if there is one, are rows of the table."""
    lines = [line for line in head.splitlines()[:-1] if line.strip()]
    labelled = [at for at, line in enumerate(lines) if line.strip() == b"END"]
    rows = lines[labelled[0] + 1 :] if labelled else lines
    return len(rows) > 0 and all(_ROW.match(line) for line in rows[:3])


FORMAT = RangeFormat(
    name="IMP table",
    suffixes=(".tab", ".txt"),
    summary="a row a pixel of line, sample, x, y, z, m, and a pixel value, after a PDS3 label or "
    "none",
    tested_with="MPFL-M-IMP-5-3DPOSITION-V1.0",
    sniff=_is_table,
    read=read_imp_table,
)
