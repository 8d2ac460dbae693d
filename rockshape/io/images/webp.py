"""WebP images."""

from typing import TYPE_CHECKING

from rockshape.io.decoding.pillow import read_picture
from rockshape.io.format import ImageFormat

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.io.format import ImageContent


def is_webp(head: bytes) -> bool:
    """Whether a RIFF file holds WebP."""
    return head[:4] == b"RIFF" and head[8:12] == b"WEBP"


def decode_webp(file: "InputFile") -> "ImageContent":
    """ImageContent, turned by its EXIF orientation; of an animation the first frame."""
    return read_picture(file, "WEBP")


FORMAT = ImageFormat(
    name="WebP",
    suffixes=(".webp",),
    summary="colour, 8 bits a channel, turned by its EXIF orientation",
    tested_with="Pillow, OpenCV",
    sniff=is_webp,
    read=decode_webp,
)
