"""PDS range products of Mars rovers: XYZ and RNG images, versions 3 and 4, by pdr."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.io.decoding.pds import image_of, is_pds3, is_pds4
from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster
from rockshape.point_grid.range_kinds import RangeKind

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

CONSTANTS = ("MISSING_CONSTANT", "INVALID_CONSTANT", "missing_constant", "invalid_constant")


def read_pds_range(file: "InputFile", _: ImageInfo) -> RangeRaster:
    """Points (rows, cols, 3) of an XYZ product or distance (rows, cols) of an RNG product, m.

    What the label calls missing or invalid is no measurement. Range of an RNG product is measured
    along the ray from the camera.
    Raises: InputError for an image of neither one nor three bands of floats.
    Source: MER, MSL and M2020 camera data-product software interface specifications.
    """
    name, product = image_of(file)
    values: NDArray[Any] = np.asarray(product[name])
    if values.ndim == 3 and values.shape[0] in (1, 3):
        values = np.moveaxis(values, 0, -1)
    if values.ndim == 3 and values.shape[-1] == 1:
        values = values[..., 0]
    if values.dtype.kind != "f" or values.shape[2:] not in ((), (3,)):
        raise InputError(
            f"{file.path}: expected an XYZ or RNG product, one or three bands of floats, found "
            f"{values.shape} of {values.dtype}"
        )
    kind: RangeKind = "xyz" if values.ndim == 3 else "distance"
    return RangeRaster(
        values.astype(values.dtype.newbyteorder("=")), kind=kind, no_data=_missing(product)
    )


def _missing(product: Any) -> tuple[float, ...]:
    """Constants of the label; of three for the bands, each. Zeros are told by the point itself."""
    found = (product.metaget(name) for name in CONSTANTS)
    values = [value for each in found for value in _flat(each)]
    return tuple(value for value in dict.fromkeys(values) if value != 0)


def _flat(value: object) -> Iterable[float]:
    if isinstance(value, (list, tuple)):
        return [one for each in value for one in _flat(each)]
    try:
        return [float(str(value))]
    except ValueError:
        return []


PDS3 = RangeFormat(
    name="PDS3",
    suffixes=(".img", ".lbl", ".xyz", ".rng"),
    summary="XYZ product of points in a rover's frame, or RNG product of length along the ray, m, "
    "attached or detached label; with the extra `pds`",
    tested_with="PDS Standards Reference 3.8, MER camera SIS",
    sniff=is_pds3,
    read=read_pds_range,
)
PDS4 = RangeFormat(
    name="PDS4",
    suffixes=(".xml",),
    summary="label of an XYZ or RNG product; with the extra `pds`",
    tested_with="PDS4 Standards Reference 1.16",
    sniff=is_pds4,
    read=read_pds_range,
)
