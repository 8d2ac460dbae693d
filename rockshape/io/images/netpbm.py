"""Netpbm images."""

from typing import TYPE_CHECKING

from rockshape.io.decoding.pillow import read_picture
from rockshape.io.format import ImageFormat, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.io.format import ImageContent


def decode_netpbm(file: "InputFile") -> "ImageContent":
    """ImageContent of PBM, PGM or PPM, text or binary, 8 or 16 bits."""
    return read_picture(file, "PPM")


FORMAT = ImageFormat(
    name="Netpbm",
    suffixes=(".pgm", ".ppm", ".pbm", ".pnm"),
    summary="PBM, PGM and PPM: black and white, grey or colour, 8 or 16 bits, text or binary",
    tested_with="Pillow, OpenCV, pgm(5), pbm(5)",
    sniff=magic(*(b"P%d" % number for number in range(1, 7))),
    read=decode_netpbm,
)
