"""PNG images."""

from functools import partial

from rockshape.io.decoding.raster import PNG_MAGIC, decode_picture, encode_raster
from rockshape.io.format import ImageFormat, magic

FORMAT = ImageFormat(
    name="PNG",
    suffixes=(".png",),
    summary="grey, colour or palette, 8 or 16 bits a channel",
    sniff=magic(PNG_MAGIC),
    read=decode_picture,
    write=partial(encode_raster, ".png"),
)
