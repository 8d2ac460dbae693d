"""PNG label images."""

from typing import TYPE_CHECKING

from rockshape.io.decoding.label_image import instances_of, label_image_16bit
from rockshape.io.decoding.raster import PNG_MAGIC, decode_picture, encode_raster
from rockshape.io.format import ImageInfo, LabelFormat, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instances


def read_png(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of a grey PNG of any depth, or of the indices of one with a palette.

    Raises: InputError where it is no label image.
    """
    return instances_of(file, decode_picture(file), info)


def write_png(instances: "Instances") -> bytes:
    """Grey PNG of 16 bits. Raises: InputError for overlaps and for ids that it cannot hold."""
    return encode_raster(".png", label_image_16bit(instances))


FORMAT = LabelFormat(
    name="PNG",
    suffixes=(".png",),
    summary="grey of 1 to 16 bits or palette indices, a rock's id in each of its pixels, 0 "
    "elsewhere; or one mask, each piece a rock",
    tested_with="Pillow, OpenCV, ISO/IEC 15948",
    sniff=magic(PNG_MAGIC),
    read=read_png,
    write=write_png,
)
