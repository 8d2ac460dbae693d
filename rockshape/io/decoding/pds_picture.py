"""Pictures of PDS products."""

from typing import TYPE_CHECKING

import numpy as np

from rockshape.io.decoding.pds import image_of
from rockshape.io.format import ImageContent
from rockshape.io.pixels import stretch

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

NO_VALUE = ("MISSING_CONSTANT", "INVALID_CONSTANT", "CORE_NULL")  # keywords of a PDS3 label


def decode_pds(file: "InputFile") -> ImageContent:
    """ImageContent of a PDS product: 8 bits as they are, anything else stretched, bands as colours.

    What the label declares missing or invalid is black.
    """
    name, product = image_of(file)
    values = np.asarray(product[name])
    if values.ndim == 3:
        values = np.moveaxis(values, 0, -1)  # pdr puts bands first
    file.check_shape(values.shape, item_bytes=values.dtype.itemsize)
    if values.dtype == np.uint8:
        return ImageContent(values)
    label = product.metaget_(name) or {}
    declared = (label.get(key) for key in NO_VALUE)
    absent = [each for each in declared if isinstance(each, int | float)]
    return ImageContent(stretch(np.where(np.isin(values, absent), np.nan, values)))
