"""Image files of the scene."""

from collections.abc import Iterator

import numpy as np

from tests.hostile.scene import image
from tests.hostile.seed_files.encoding import File, pds3, pds4, pillow, tiff


def files() -> Iterator[File]:
    """An image of each format."""
    grey, colour = image(), np.dstack([image()] * 3)
    for name, suffix in (("PNG", ".png"), ("JPEG", ".jpg"), ("WebP", ".webp"), ("BMP", ".bmp")):
        yield name, suffix, pillow(colour, name)
    yield "PNG", ".png", pillow(grey, "PNG")
    yield "Netpbm", ".pgm", pillow(grey, "PPM")
    yield "TIFF", ".tif", tiff(grey)
    yield "TIFF", ".tif", tiff(colour, compression="zlib", photometric="rgb")
    yield "TIFF", ".tif", tiff(grey.astype(np.float32) / 255)
    yield "TIFF", ".tif", tiff(grey, imagej=True, resolution=(1e3, 1e3), metadata={"unit": "m"})
    yield "PDS3", ".img", pds3(grey, sample_type="UNSIGNED_INTEGER")
    yield "PDS4", ".xml", pds4(grey, data_type="UnsignedByte")
