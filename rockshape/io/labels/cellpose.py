"""Cellpose segmentations (`_seg.npy`): a pickled dictionary within an NPY file.

Source: cellpose.io.masks_flows_to_seg of Cellpose 2 to 4.
"""

import io
import pickle
from typing import TYPE_CHECKING, Any

import numpy as np

from rockshape.errors import InputError
from rockshape.io.decoding.label_image import instances_of
from rockshape.io.decoding.numpy_files import HEADERS, NPY_MAGIC
from rockshape.io.decoding.numpy_pickle import load_numpy_pickle
from rockshape.io.format import ImageInfo, LabelFormat

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instances

HEADER_BYTES = 128


def is_cellpose(head: bytes) -> bool:
    """Whether content is an NPY file of a single object."""
    header = head[:HEADER_BYTES]
    return header.startswith(NPY_MAGIC) and b"'|O'" in header and b"'shape': ()" in header


def read_cellpose(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of the label image `masks`; nothing of the pickle is executed.

    Raises: InputError where it holds anything but NumPy's arrays and plain values, or no masks.
    """
    try:
        content = _unpickled(file)
    except pickle.UnpicklingError as error:
        raise file.refusal(f"pickled objects, which are never loaded: {error}") from None
    masks = content.get("masks") if isinstance(content, dict) else None
    if not isinstance(masks, np.ndarray):
        raise InputError(f"{file.path}: expected Cellpose's dictionary with masks, found none")
    return instances_of(file, masks, info)


def _unpickled(file: "InputFile") -> Any:
    stream = io.BytesIO(file.data)
    HEADERS[np.lib.format.read_magic(stream)](stream)
    content = load_numpy_pickle(stream)
    whole = isinstance(content, np.ndarray) and content.dtype == object and content.size == 1
    return content.item() if whole else content


FORMAT = LabelFormat(
    name="Cellpose",
    suffixes=(".npy",),
    summary="`_seg.npy`, whose `masks` are a label image; nothing in it is executed",
    tested_with="NumPy, cellpose.io",
    sniff=is_cellpose,
    read=read_cellpose,
)
