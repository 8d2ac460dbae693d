"""NumPy label images and stacks of masks."""

from typing import TYPE_CHECKING

from rockshape.io.decoding.label_image import instances_of
from rockshape.io.decoding.numpy_files import NPY_MAGIC, load_npy
from rockshape.io.format import ImageInfo, LabelFormat, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instances


def read_npy(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of whole numbers (rows, cols), or of masks (n, rows, cols) or (rows, cols, n).

    Raises: InputError for any other array.
    """
    return instances_of(file, load_npy(file), info)


FORMAT = LabelFormat(
    name="NPY",
    suffixes=(".npy",),
    summary="array (rows, cols) of whole numbers, a rock's id in each of its pixels; or a stack "
    "(n, rows, cols) of masks, which may overlap",
    tested_with="NumPy",
    sniff=magic(NPY_MAGIC),
    read=read_npy,
)
