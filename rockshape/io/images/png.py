"""PNG images."""

from functools import partial
from typing import TYPE_CHECKING

from rockshape.io.decoding.pillow import read_picture
from rockshape.io.decoding.raster import PNG_MAGIC, encode_raster
from rockshape.io.format import ImageFormat, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.io.format import ImageContent


def decode_png(file: "InputFile") -> "ImageContent":
    """ImageContent, turned by the orientation of its eXIf chunk."""
    return read_picture(file, "PNG")


FORMAT = ImageFormat(
    name="PNG",
    suffixes=(".png",),
    summary="grey, colour or palette, 1 to 16 bits a channel",
    tested_with="Pillow, OpenCV",
    sniff=magic(PNG_MAGIC),
    read=decode_png,
    write=partial(encode_raster, ".png"),
)
