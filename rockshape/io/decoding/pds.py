"""PDS products, versions 3 and 4, by pdr, the extra `pds`."""

from typing import TYPE_CHECKING, Any

import numpy as np

from rockshape.errors import InputError

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

PDS3_MARKS = (b"PDS_VERSION_ID", b"ODL_VERSION_ID", b"CCSD3ZF")
VICAR_MARK = b"LBLSIZE="  # of products whose own label comes first
PDS4_MARKS = (b"<Product_Observational", b"pds.nasa.gov/pds4/")
MARK_BYTES = 4096  # within which a PDS3 label begins


def is_pds3(head: bytes) -> bool:
    """Whether a file begins with a PDS3 label, attached or detached."""
    start = head[:MARK_BYTES].lstrip()
    return start.startswith(PDS3_MARKS) or (
        start.startswith(VICAR_MARK) and PDS3_MARKS[0] in head[:MARK_BYTES]
    )


def is_pds4(head: bytes) -> bool:
    """Whether a file is a PDS4 label."""
    return head.lstrip(b"\xef\xbb\xbf \r\n\t").startswith(b"<?xml") and any(
        mark in head for mark in PDS4_MARKS
    )


def open_pds(file: "InputFile") -> Any:
    """Product as pdr's `Data`, whose label is parsed and whose objects are read when asked for.

    Raises: InputError where pdr is not installed, and whatever it does for a damaged product.
    """
    try:
        import pdr  # noqa: PLC0415 - of an extra
    except ImportError:
        raise InputError(
            f"{file.path}: PDS: expected the package pdr (pip install 'rockshape[pds]'), found none"
        ) from None
    return pdr.read(str(file.path))


def image_of(file: "InputFile") -> tuple[str, Any]:
    """Name of a product's image object and the product; of several images the first.

    Raises: InputError where it has none.
    """
    product = open_pds(file)
    names = list(map(str, product.keys()))
    images = [name for name in names if "IMAGE" in name.upper() and "HEADER" not in name.upper()]
    images += [name for name in names if "ARRAY" in name.upper()]
    for name in images or names:
        values = product[name]
        if isinstance(values, np.ndarray) and values.ndim in (2, 3) and values.dtype.kind in "biuf":
            return name, product
    found = ", ".join(sorted(names)) or "nothing"
    raise InputError(f"{file.path}: expected a PDS image, found {found}; a table is none")
