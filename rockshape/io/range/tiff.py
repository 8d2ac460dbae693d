"""TIFF range."""

import io
from typing import TYPE_CHECKING

import numpy as np

from rockshape.io.decoding.raster import TIFF_MAGIC, decode_tiff
from rockshape.io.decoding.tiff_directories import check_directories
from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster, magic

if TYPE_CHECKING:
    from tifffile import TiffTag

    from rockshape.io.files import InputFile

GDAL_NODATA = 42113


def read_tiff(file: "InputFile", _: ImageInfo) -> RangeRaster:
    """Z-depth (rows, cols) or points (rows, cols, 3), m, or whole steps; GDAL's no-data value.

    A page of three samples, three pages of a coordinate each and the many pages that tifffile makes
    of an array (rows, cols, 3) all hold points.
    """
    import tifffile  # noqa: PLC0415 - other formats do without its 20 ms

    check_directories(file.data)
    with tifffile.TiffFile(io.BytesIO(file.data)) as tiff:
        no_data = _no_data(tiff.pages.first.tags.get(GDAL_NODATA))
        series = tiff.series[0]
        if len(tiff.pages) == 1:
            return RangeRaster(decode_tiff(file), no_data=no_data)
        if len(tiff.series) > 1 or series.ndim != 3:
            raise ValueError(f"{len(tiff.pages)} pages")
        file.check_shape(series.shape, item_bytes=series.dtype.itemsize)
        values = np.asarray(series.asarray())
    return RangeRaster(
        values if values.shape[-1] == 3 else np.moveaxis(values, 0, -1), no_data=no_data
    )


def _no_data(tag: "TiffTag | None") -> tuple[float, ...]:
    """No-data value of the tag GDAL_NODATA, which is text.

    Source: GDAL's GeoTIFF driver, tag 42113.
    """
    return () if tag is None else (float(str(tag.value).strip(" \0")),)


FORMAT = RangeFormat(
    name="TIFF",
    suffixes=(".tif", ".tiff"),
    summary="one page of z-depth (rows, cols) or points (rows, cols, 3), m, or whole steps of "
    "`depth_scale`; GDAL's no-data tag is heeded",
    tested_with="tifffile",
    sniff=magic(*TIFF_MAGIC),
    read=read_tiff,
)
