"""Contact sheet of a dataset."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.dataset.depth_colours import depth_colours
from synth.dataset.files import write_png

Bytes = NDArray[np.uint8]
Image = NDArray[Any]  # (rows, cols), of one of the kinds that pictures have

_CELL_PX = 240  # the longer side of a small picture
_GAP_PX = 6
MAX_SCENES = 8
_MAX_VIEWS = 4
_PAPER = 250
_TINT = 0.45  # share of a rock's colour in its pixels
_GOLDEN = 0.618033988749895  # steps of hue that keep neighbours apart


def write_contact_sheet(path: Path, rows: Sequence[Bytes]) -> None:
    """Write a PNG of rows (rows, cols, 3), one below the other."""
    width = max(row.shape[1] for row in rows)
    padded = [
        cv2.copyMakeBorder(
            row, 0, 0, 0, width - row.shape[1], cv2.BORDER_CONSTANT, value=[_PAPER] * 3
        )
        for row in rows
    ]
    write_png(path, np.concatenate(padded).astype(np.uint8))


def sheet_row(folder: Path) -> Bytes:
    """Contact sheet's row of one scene, (rows, cols, 3): image and depth of the first views.

    Rocks are tinted, each with a colour of its own; depth runs from yellow, near, to violet, far,
    over each picture's own range, white where nothing was measured.
    """
    cells = []
    pictures = folder / "rgb" if (folder / "rgb").is_dir() else folder / "gray"
    for path in sorted(pictures.iterdir())[:_MAX_VIEWS]:
        image, depth, labels = (
            _read(place / path.name) for place in (pictures, folder / "depth", folder / "labels")
        )
        cells += [_tinted(image, labels), _coloured(depth)]
    gap = np.full((cells[0].shape[0], _GAP_PX, 3), _PAPER, dtype=np.uint8)
    row = np.concatenate([part for cell in cells for part in (cell, gap)], axis=1)
    foot = np.full((_GAP_PX, row.shape[1], 3), _PAPER, dtype=np.uint8)
    return np.concatenate([row, foot])


def _read(path: Path) -> Image:
    image = cv2.imdecode(np.frombuffer(path.read_bytes(), np.uint8), cv2.IMREAD_UNCHANGED)
    return np.asarray(image)


def _tinted(image: Image, labels: Image) -> Bytes:
    """Small picture (rows, cols, 3) with each rock in a colour of its own."""
    grey = image if image.dtype == np.uint8 else (image >> 8).astype(np.uint8)
    small = _shrunk(grey, cv2.INTER_AREA)
    small = cv2.cvtColor(small, cv2.COLOR_GRAY2BGR) if small.ndim == 2 else small
    rock = _shrunk(labels.astype(np.uint16), cv2.INTER_NEAREST)
    hue = np.rint(180.0 * ((rock * _GOLDEN) % 1.0)).astype(np.uint8) % 180
    full = np.full_like(hue, 255)
    colour = cv2.cvtColor(np.stack([hue, full // 2, full], axis=-1), cv2.COLOR_HSV2BGR)
    mixed = np.rint((1.0 - _TINT) * small + _TINT * colour).astype(np.uint8)
    return np.where((rock > 0)[..., None], mixed, small)


def _coloured(depth: Image) -> Bytes:
    """Depth as a small picture in colours, (rows, cols, 3)."""
    small = _shrunk(depth.astype(np.float32), cv2.INTER_NEAREST)
    return depth_colours(small, small > 0, paper=_PAPER)


def _shrunk(image: Image, how: int) -> Image:
    factor = _CELL_PX / max(image.shape)
    size = (round(image.shape[1] * factor), round(image.shape[0] * factor))
    return np.asarray(cv2.resize(image, size, interpolation=how))
