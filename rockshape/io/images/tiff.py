"""TIFF images of any type, GeoTIFF and ImageJ's among them."""

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.io.decoding.raster import encode_raster
from rockshape.io.decoding.tiff import PALETTE, TIFF_MAGIC, WHITE_IS_ZERO, TiffImage, read_tiff
from rockshape.io.format import ImageContent, ImageFormat, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

# photometric interpretations: CMYK, YCbCr, L*a*b*, and the raw mosaics of sensors
OTHER_COLOURS = (5, 6, 8, 32803, 34892)


def decode_tiff_picture(file: "InputFile") -> ImageContent:
    """ImageContent of one page: a palette as its colours, white as the largest level.

    Raises: InputError for several pages, raw sensor mosaics and colours that are not RGB.
    """
    image = read_tiff(file)
    if image.photometric in OTHER_COLOURS:
        raise InputError(
            f"{file.path}: expected a TIFF of grey levels, RGB or a palette, "
            f"found photometric interpretation {image.photometric}"
        )
    return ImageContent(_levels(image), image.pixel_size_m, image.orientation, image.map_frame)


def _levels(image: TiffImage) -> NDArray[Any]:
    values = image.values
    if image.photometric == PALETTE and image.colour_map is not None:
        colours = (image.colour_map >> 8).astype(np.uint8)  # some writers leave the low byte 0
        indices = values[..., 0] if values.ndim == 3 else values  # the second is alpha
        return np.asarray(colours[:, indices].transpose(1, 2, 0))
    if values.dtype.kind == "f" and image.no_data is not None:
        values = np.where(values == image.no_data, np.nan, values)
    full = 2**image.bits - 1
    if values.dtype.kind == "u" and image.bits not in (8, 16, 32, 64):
        values = values.astype(np.float32) / np.float32(full)
        full = 1
    if image.photometric != WHITE_IS_ZERO:
        return values
    if values.dtype == bool:
        return ~values
    if values.dtype.kind == "u":
        return np.asarray(values.dtype.type(full) - values)
    return -values if full > 1 else 1 - values


FORMAT = ImageFormat(
    name="TIFF",
    suffixes=(".tif", ".tiff"),
    summary="one page of any whole numbers or floats, grey, colour or palette; BigTIFF; the pixel "
    "size of GeoTIFF and ImageJ, map coordinates of GeoTIFF",
    tested_with="tifffile, Pillow, OpenCV, TIFF 6.0",
    sniff=magic(*TIFF_MAGIC),
    read=decode_tiff_picture,
    write=partial(encode_raster, ".tif"),
)
