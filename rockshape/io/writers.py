"""Writers of each kind of file, through the format registry; a file is written whole or not at all.

All raise InputError, in one line that names the file, for what cannot be written.
"""

from pathlib import Path
from typing import TYPE_CHECKING

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


def write_table(path: Path | str, frame: "pd.DataFrame") -> None:
    """Write a table in the format that the suffix names."""
    write_bytes(Path(path), TABLES.encode(path, frame))
