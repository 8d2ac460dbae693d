"""Memory and time of measuring a large picture by the image alone, an orthophoto's size."""

from pathlib import Path
from tempfile import TemporaryDirectory

import cv2
import numpy as np
from case import Case, Cell, Column, Table
from made_frame import make_frame
from timing import in_fresh_process, memory_mb, timed

import rockshape

TILE_PX, ROCKS_IN_TILE = 1500, 60


def large_picture(*, rows: int = 9000, cols: int = 12_000) -> list[Table]:
    """Read and measure a picture of so many pixels, grey and in colour, in processes of their own.

    The picture repeats a drawn frame with sixty rocks.
    """
    tile = make_frame(side_px=TILE_PX, rocks=ROCKS_IN_TILE).image
    repeats = -(-rows // TILE_PX), -(-cols // TILE_PX)
    grey = np.tile(np.rint(255 * tile).astype(np.uint8), repeats)[:rows, :cols]
    columns = (
        Column("picture"),
        Column("pixels", "million", ".0f"),
        Column("rocks found", "", "d"),
        Column("processor", "s"),
        Column("peak memory", "MB", ",.0f"),
    )
    with TemporaryDirectory() as folder:
        table = []
        for name, pixels in (("grey", grey), ("colour", np.dstack([grey] * 3))):
            path = Path(folder) / f"{name}.png"
            cv2.imwrite(str(path), pixels)
            table.append((name, rows * cols / 1e6, *in_fresh_process(_measured, str(path))))
    return [Table(columns, table)]


def _measured(path: str) -> tuple[Cell, ...]:
    found: list[rockshape.Measurement] = []
    cost = timed(lambda: found.append(rockshape.measure(rockshape.read(path))))
    return len(found[0]), cost.cpu_s, memory_mb(peak=True)


LARGE_PICTURE_CASE = Case(
    name="large_picture",
    what="memory and processor time of measuring a picture of 108 million pixels by itself",
    run=large_picture,
    smallest={"rows": 300, "cols": 400},
)
