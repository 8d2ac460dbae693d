"""BMP images."""

from typing import TYPE_CHECKING

from rockshape.io.decoding.pillow import read_picture
from rockshape.io.format import ImageFormat, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.io.format import ImageContent


def decode_bmp(file: "InputFile") -> "ImageContent":
    """ImageContent; a palette as its colours."""
    return read_picture(file, "BMP")


FORMAT = ImageFormat(
    name="BMP",
    suffixes=(".bmp", ".dib"),
    summary="grey, colour or palette",
    tested_with="Pillow, OpenCV",
    sniff=magic(b"BM"),
    read=decode_bmp,
)
