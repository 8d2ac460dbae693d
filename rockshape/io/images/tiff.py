"""TIFF images."""

from functools import partial

from rockshape.io.decoding.raster import TIFF_MAGIC, decode_tiff, encode_raster
from rockshape.io.format import ImageFormat, magic

FORMAT = ImageFormat(
    name="TIFF",
    suffixes=(".tif", ".tiff"),
    summary="one page, grey, colour or palette, 8 or 16 bits a channel",
    sniff=magic(*TIFF_MAGIC),
    read=decode_tiff,
    write=partial(encode_raster, ".tif"),
)
