"""Range files: metres in 32 bits, with a stated number where nothing was measured."""

from pathlib import Path
from typing import Any

import cv2
import numpy as np
from msgspec import UnsetType

from synth.arrays import Floats
from synth.spec import SceneSpec, dataset_of

RANGE_FOLDER = "range"


def hole_value(spec: SceneSpec) -> float | None:
    """Number that stands for holes; None where no range files are asked for."""
    value = dataset_of(spec).hole_value
    return None if isinstance(value, UnsetType) else float(value)


def hole_table(spec: SceneSpec) -> dict[str, Any]:
    """Entry of camera.json that states the number, as text, since JSON has no infinity."""
    value = dataset_of(spec).hole_value
    return {} if isinstance(value, UnsetType) else {"hole_value": value}


def write_range(folder: Path, number: int, depth_m: Floats, hole: float | None) -> None:
    """Write a view's z-depth, (rows, cols), as a TIFF of 32-bit floats, where holes have a number.

    Nothing is written without such a number.
    """
    if hole is None:
        return
    values = np.where(np.isnan(depth_m), hole, depth_m).astype(np.float32)
    uncompressed = (cv2.IMWRITE_TIFF_COMPRESSION, 1)
    _, data = cv2.imencode(".tiff", values, uncompressed)
    (folder / RANGE_FOLDER / f"{number:06d}.tiff").write_bytes(data.tobytes())
