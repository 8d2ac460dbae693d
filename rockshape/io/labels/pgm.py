"""PGM label images."""

from typing import TYPE_CHECKING

from rockshape.io.decoding.label_image import instances_of
from rockshape.io.decoding.pgm import pgm_numbers
from rockshape.io.format import ImageInfo, LabelFormat, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instances


def read_pgm(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of a PGM of 8 or 16 bits, text or binary: its numbers as they are stored."""
    return instances_of(file, pgm_numbers(file)[0], info)


FORMAT = LabelFormat(
    name="PGM",
    suffixes=(".pgm",),
    summary="as PNG, 8 or 16 bits, text or binary",
    tested_with="Pillow, OpenCV, pgm(5)",
    sniff=magic(b"P5", b"P2"),
    read=read_pgm,
)
