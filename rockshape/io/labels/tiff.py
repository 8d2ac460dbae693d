"""TIFF label images."""

from typing import TYPE_CHECKING

from rockshape.io.decoding.label_image import instances_of, label_image_16bit
from rockshape.io.decoding.raster import TIFF_MAGIC, decode_tiff, encode_raster
from rockshape.io.format import ImageInfo, LabelFormat, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instances


def read_tiff(file: "InputFile", _: ImageInfo) -> "Instances":
    """Instances of a grey TIFF. Raises: InputError where it is no label image."""
    return instances_of(file, decode_tiff(file))


def write_tiff(instances: "Instances") -> bytes:
    """Grey TIFF of 16 bits. Raises: InputError for overlaps and for ids that it cannot hold."""
    return encode_raster(".tif", label_image_16bit(instances))


FORMAT = LabelFormat(
    name="TIFF",
    suffixes=(".tif", ".tiff"),
    summary="one page of whole numbers up to 31 bits, a rock's id in each of its pixels",
    sniff=magic(*TIFF_MAGIC),
    read=read_tiff,
    write=write_tiff,
)
