"""TIFF label images and stacks of masks."""

from typing import TYPE_CHECKING

from rockshape.io.decoding.label_image import instances_of, label_image_16bit
from rockshape.io.decoding.mask_stack import stack_instances
from rockshape.io.decoding.raster import TIFF_MAGIC, encode_raster
from rockshape.io.decoding.tiff import read_stack
from rockshape.io.format import ImageInfo, LabelFormat, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instances


def read_tiff(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of the stored numbers, whatever they look like; of several pages a mask each.

    Raises: InputError where they are no labels, and for lossy compression.
    """
    pages = read_stack(file)
    return (
        stack_instances(file, pages, info) if len(pages) > 1 else instances_of(file, pages[0], info)
    )


def write_tiff(instances: "Instances") -> bytes:
    """Grey TIFF of 16 bits. Raises: InputError for overlaps and for ids that it cannot hold."""
    return encode_raster(".tif", label_image_16bit(instances))


FORMAT = LabelFormat(
    name="TIFF",
    suffixes=(".tif", ".tiff"),
    summary="whole numbers, a rock's id in each of its pixels, whatever the photometric tag says; "
    "or a page a mask, which may overlap",
    tested_with="tifffile, Pillow, OpenCV",
    sniff=magic(*TIFF_MAGIC),
    read=read_tiff,
    write=write_tiff,
)
