"""Writers of each kind of file, through the format registry; a file is written whole or not at all.

All raise InputError, in one line that names the file, for what cannot be written.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rockshape.io.files import write_bytes
from rockshape.io.registry import IMAGES, LABELS, TABLES

if TYPE_CHECKING:
    import pandas as pd

    from rockshape.rock.instances import Instances


def write_image(path: Path | str, pixels: NDArray[np.uint8] | NDArray[np.uint16]) -> None:
    """Write an image (rows, cols) or (rows, cols, 3) RGB in the format that the suffix names."""
    write_bytes(Path(path), IMAGES.encode(path, pixels))


def write_labels(path: Path | str, instances: "Instances") -> None:
    """Write labels in the format that the suffix names.

    Raises: InputError for instances that the format cannot hold, overlaps in a label image.
    """
    write_bytes(Path(path), LABELS.encode(path, instances))


SIDE_SUFFIX = ".meta.json"  # of the file beside a table that has no room for metadata


def write_table(
    path: Path | str, frame: "pd.DataFrame", *, about: Mapping[str, Any] | None = None
) -> None:
    """Write a table in the format that the suffix names.

    What is known `about` it goes into the file's metadata, or where the format has none into a file
    beside it, `rocks.csv.meta.json` of `rocks.csv`.
    """
    path = Path(path)
    described = TABLES.for_writing(path).write_described
    if about is not None and described is not None:
        write_bytes(path, described(frame, about))
        return
    write_bytes(path, TABLES.encode(path, frame))
    if about is not None:
        write_side_file(path, about)


def write_side_file(path: Path, about: Mapping[str, Any]) -> None:
    """Write what is known about a table beside it."""
    text = json.dumps(about, indent=1, ensure_ascii=False)
    write_bytes(path.with_name(path.name + SIDE_SUFFIX), f"{text}\n".encode())
