"""NumPy archives with a label image or a stack of masks."""

from typing import TYPE_CHECKING

from rockshape.io.decoding.label_image import instances_of
from rockshape.io.decoding.numpy_files import ZIP_MAGIC, load_npz
from rockshape.io.format import ImageInfo, LabelFormat, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instances

KEYS = ("labels", "label", "masks", "mask", "instances", "arr_0")


def read_npz(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of the array under `labels`, `masks` or a like key, or of the only one.

    Raises: InputError where the archive has none of the keys.
    """
    return instances_of(file, load_npz(file, KEYS, or_the_only=True), info)


FORMAT = LabelFormat(
    name="NPZ",
    suffixes=(".npz",),
    summary="array as NPY has it, under `labels`, `masks`, `instances` or `arr_0`, or the only one",
    tested_with="NumPy",
    sniff=magic(ZIP_MAGIC),
    read=read_npz,
)
