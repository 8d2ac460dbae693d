"""OpenEXR range: a renderer's Z channel or its position pass, by OpenEXR, the extra `exr`."""

import contextlib
import io
from typing import TYPE_CHECKING, Any

import numpy as np

from rockshape.errors import InputError
from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster, magic
from rockshape.io.guard import quiet_libraries_in_c

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

MAGIC = b"\x76\x2f\x31\x01"
MAX_CHANNELS = 64  # all of which are decoded
POSITION = ("X", "Y", "Z")
DEPTH = ("Z", "DEPTH", "V")  # of OpenEXR, of Blender's passes and of its files of one pass


def read_exr(file: "InputFile", _: ImageInfo) -> RangeRaster:
    """Z-depth (rows, cols) of the channel Z, or points (rows, cols, 3) of X, Y and Z, m.

    Channels can have a layer before their name, `ViewLayer.Depth.Z`; one channel of any name is
    z-depth. Whole numbers are steps.
    Raises: InputError where OpenEXR is not installed, and for other or several such channels.
    Source: OpenEXR, technical introduction, "Channel names"; Z is the distance from the camera.
    """
    try:
        import OpenEXR  # noqa: PLC0415 - of an extra
    except ImportError:
        raise InputError(
            f"{file.path}: EXR: expected the package OpenEXR (pip install 'rockshape[exr]'), "
            f"found none"
        ) from None
    with quiet_libraries_in_c(), contextlib.redirect_stdout(io.StringIO()):
        header = OpenEXR.File(io.BytesIO(file.data), header_only=True, num_threads=0).header()
        _check_header(file, header)
        whole = OpenEXR.File(io.BytesIO(file.data), separate_channels=True, num_threads=0)
        channels: dict[str, Any] = whole.channels()
    names = _position(list(channels)) or [_depth(file, list(channels))]
    values = [np.asarray(channels[name].pixels) for name in names]
    return RangeRaster(values[0] if len(values) == 1 else np.stack(values, axis=-1))


def _check_header(file: "InputFile", header: dict[str, Any]) -> None:
    """Check size and windows before pixels are decoded."""
    data, shown = (
        tuple(int(value) for corner in header[name] for value in corner)
        for name in ("dataWindow", "displayWindow")
    )
    file.check_shape((data[3] - data[1] + 1, data[2] - data[0] + 1), item_bytes=4)
    if data != shown:
        raise InputError(
            f"{file.path}: expected pixels for the whole picture {shown}, found those of {data}"
        )
    if len(header["channels"]) > MAX_CHANNELS:
        raise file.refusal(f"{len(header['channels'])} channels")
    if any((each.xSampling, each.ySampling) != (1, 1) for each in header["channels"]):
        raise file.refusal("channels of fewer pixels")


def _position(names: list[str]) -> list[str]:
    """Channels X, Y and Z of the first layer that has all three."""
    layers = dict.fromkeys(name.rpartition(".")[0] for name in names)
    for layer in layers:
        triple = [f"{layer}.{axis}" if layer else axis for axis in POSITION]
        if set(triple) <= set(names):
            return triple
    return []


def _depth(file: "InputFile", names: list[str]) -> str:
    """Channel of z-depth."""
    if len(names) == 1:
        return names[0]
    found = [name for name in names if name.rpartition(".")[2].upper() in DEPTH]
    if len(found) != 1:
        raise file.refusal(f"the channels {', '.join(names)}, not one Z")
    return found[0]


FORMAT = RangeFormat(
    name="OpenEXR",
    suffixes=(".exr",),
    summary="channel `Z` of z-depth, or `X`, `Y` and `Z` of points, m, halves or floats, any "
    "compression; with the extra `exr`",
    tested_with="OpenEXR file layout",
    sniff=magic(MAGIC),
    read=read_exr,
)
