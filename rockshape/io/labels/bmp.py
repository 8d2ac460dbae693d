"""BMP label images."""

from typing import TYPE_CHECKING

from rockshape.io.decoding.label_image import instances_of
from rockshape.io.decoding.pillow import read_numbers
from rockshape.io.format import ImageInfo, LabelFormat, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instances


def read_bmp(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of a grey BMP, or of palette indices. Raises: InputError for colours."""
    return instances_of(file, read_numbers(file, "BMP"), info)


FORMAT = LabelFormat(
    name="BMP",
    suffixes=(".bmp", ".dib"),
    summary="as PNG, 8 bits",
    tested_with="Pillow, OpenCV",
    sniff=magic(b"BM"),
    read=read_bmp,
)
