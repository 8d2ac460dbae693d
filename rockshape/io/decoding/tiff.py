"""TIFF pages: the numbers that a file stores, and the tags that say what they mean.

tifffile reads every layout and type that is not compressed or by Deflate; other compressions and
packed bits are libtiff's, which Pillow and OpenCV bring. imagecodecs, which tifffile would use, is
not asked: its decoders crash the process on damaged data.
"""

import io
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.io.decoding.libtiff import by_libtiff, orientation_of
from rockshape.io.decoding.orientation import UPRIGHT, turn
from rockshape.io.decoding.tiff_directories import check_directories
from rockshape.io.decoding.tiff_map import map_frame
from rockshape.io.decoding.tiff_pixel_size import pixel_size_m

if TYPE_CHECKING:
    from tifffile import TiffFile, TiffPage

    from rockshape.camera.map_frame import MapFrame
    from rockshape.io.files import InputFile

TIFF_MAGIC = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
WHITE_IS_ZERO, RGB, PALETTE, YCBCR = 0, 2, 3, 6  # photometric interpretations
JPEGS = (6, 7)  # compressions
LOSSY = (*JPEGS, 33003, 33005, 34712, 34892, 50001, 50002)  # and JPEG 2000, WebP and JPEG XL
SEPARATE_PLANES = 2  # planar configuration
NO_DATA = 42113  # tag
REDUCED, MASK = 1, 4  # bits of NewSubfileType: an overview or thumbnail, a transparency mask
PLAIN = (1, 8, 32946)  # none and Deflate, which tifffile decodes by Python's own


@dataclass(frozen=True, eq=False)
class TiffImage:
    """Stored numbers (rows, cols) or (rows, cols, channels), turned as the tag says."""

    values: NDArray[Any]
    photometric: int
    bits: int  # a sample
    orientation: int = UPRIGHT
    pixel_size_m: float | None = None  # on the ground or the object, not in print
    map_frame: "MapFrame | None" = None  # None for a page that was turned
    colour_map: NDArray[np.uint16] | None = None  # (3, 2**bits)
    no_data: float | None = None  # GDAL's tag: the number that stands for none


def read_tiff(file: "InputFile") -> TiffImage:
    """Only picture of a TIFF; overviews, thumbnails and transparency masks are passed over.

    Raises: InputError for several pictures and for more pixels than the file may have, and
    whatever tifffile does for a damaged file.
    """
    with _opened(file) as (tiff, pages):
        if len(pages) != 1 or tiff.series[0].size > pages[0].size:
            count = len(pages) if len(pages) != 1 else tiff.series[0].size // pages[0].size
            raise InputError(f"{file.path}: expected a TIFF of one page, found {count} pages")
        page = pages[0]
        return TiffImage(
            values=_numbers(file, page),
            photometric=_photometric(page),
            bits=_bits(page),
            orientation=orientation_of(page),
            pixel_size_m=pixel_size_m(page, tiff.imagej_metadata),
            map_frame=map_frame(page) if orientation_of(page) == UPRIGHT else None,
            colour_map=page.colormap,
            no_data=None if page.tags.valueof(NO_DATA) is None else float(page.nodata),
        )


def read_stack(file: "InputFile") -> list[NDArray[Any]]:
    """Stored numbers of every page of a TIFF, turned as the tags say.

    Raises: InputError for lossy compression, which changes numbers.
    """
    with _opened(file) as (tiff, pages):
        page, whole = pages[0], tiff.series[0]
        if any(each.compression in LOSSY for each in pages):
            raise InputError(
                f"{file.path}: expected numbers stored without loss, "
                f"found TIFF compression {page.compression!r}"
            )
        if len(pages) == 1 and whole.size > page.size:  # ImageJ's stacks of one directory
            file.check_shape((whole.size // page.size, *page.shape), item_bytes=_item_bytes(page))
            slices = whole.asarray().reshape(-1, *page.shape)
            return [turn(each, orientation_of(page)) for each in slices]
        total = (len(pages), page.imagelength, page.imagewidth)
        file.check_shape(total, item_bytes=_item_bytes(page))
        return [_numbers(file, each) for each in pages]


@contextmanager
def _opened(file: "InputFile") -> "Iterator[tuple[TiffFile, list[TiffPage]]]":
    import tifffile  # noqa: PLC0415 - other images do without its 20 ms

    check_directories(file.data)
    with tifffile.TiffFile(io.BytesIO(file.data)) as tiff:
        pages = [tiff.pages.first, *(each.aspage() for each in tiff.pages[1:])]
        yield tiff, [each for each in pages if not each.subfiletype & (REDUCED | MASK)] or pages[:1]


def _numbers(file: "InputFile", page: "TiffPage") -> NDArray[Any]:
    """Stored numbers of a page, turned as its tag says."""
    shape = (page.imagelength, page.imagewidth, page.samplesperpixel)
    file.check_shape(shape, item_bytes=_item_bytes(page))
    if page.imagedepth > 1:
        raise InputError(
            f"{file.path}: expected a TIFF of one page, found {page.imagedepth} slices"
        )
    if page.compression in PLAIN and _bits(page) in (1, 8, 16, 32, 64):
        try:
            values = np.asarray(page.asarray())
        except Exception as error:
            if "imagecodecs" not in str(error):  # a predictor that tifffile leaves to it
                raise
        else:
            planes = values.ndim == 3 and page.planarconfig == SEPARATE_PLANES
            return turn(np.moveaxis(values, 0, -1) if planes else values, orientation_of(page))
    return by_libtiff(file, page)


def _photometric(page: "TiffPage") -> int:
    """Photometric interpretation as decoded: YCbCr within JPEG has become RGB."""
    decoded = page.photometric == YCBCR and page.compression in JPEGS
    return RGB if decoded else int(page.photometric or WHITE_IS_ZERO)


def _bits(page: "TiffPage") -> int:
    return int(np.max(page.bitspersample))


def _item_bytes(page: "TiffPage") -> int:
    return max(_bits(page) // 8, 1)
