"""Images and label images: PNG, JPEG and TIFF of 8 or 16 bits, grey or colour; labels also NPY."""

import io
import warnings
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from rockshape.errors import InputError
from rockshape.io.files import check_writable, read_bytes, write_bytes
from rockshape.io.grey import to_grey

IMAGE = "an image (PNG, JPEG or TIFF)"
LABELS = "a label image (PNG, TIFF or NPY of whole numbers, 0 the background)"
PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff")
LABEL_IMAGES = (".png", ".tif", ".tiff")  # those that hold 16 bits and lose nothing
LARGEST_LABEL = 2**31 - 1
WHITE_IS_ZERO, PALETTE, SEPARATE_PLANES = 0, 3, 2  # values of TIFF's tags


def read_image(path: Path | str) -> NDArray[np.float32]:
    """A grey image, (rows, cols) from 0 to 1. Colour becomes luma (ITU-R BT.601).

    Raises InputError for anything but a whole image of 8 or 16 bits.
    """
    path = Path(path)
    pixels = decode(path, what=IMAGE)
    if pixels.dtype not in (np.uint8, np.uint16):
        raise InputError(f"{path}: expected 8 or 16 bits a channel, found {pixels.dtype}")
    return to_grey(pixels)


def read_labels(path: Path | str, *, shape: tuple[int, ...]) -> NDArray[np.int32]:
    """A label image, (rows, cols), of the given shape; 0 is the background.

    Raises InputError where the file is no such image.
    """
    path = Path(path)
    labels = _array(path) if path.suffix.lower() == ".npy" else decode(path, what=LABELS)
    if labels.ndim != 2 or not np.issubdtype(labels.dtype, np.integer):
        raise InputError(
            f"{path}: expected {LABELS}, found {labels.ndim} dimensions of {labels.dtype}"
        )
    if labels.shape != shape[:2]:
        raise InputError(f"{path}: expected {shape[:2]} as the image has, found {labels.shape}")
    if labels.min() < 0 or labels.max() > LARGEST_LABEL:
        raise InputError(f"{path}: expected {LABELS}, found {labels.min()} to {labels.max()}")
    return labels.astype(np.int32)


def _array(path: Path) -> NDArray[np.generic]:
    """The array of an .npy file; objects in it are never loaded."""
    try:
        array = np.load(io.BytesIO(read_bytes(path, what=LABELS)), allow_pickle=False)
    except (ValueError, EOFError, OSError) as error:
        raise InputError(f"{path}: expected {LABELS}, found {error or 'no array'}") from None
    if not isinstance(array, np.ndarray):  # an .npz under another name
        raise InputError(f"{path}: expected {LABELS}, found several arrays")
    return array


def write_image(path: Path | str, pixels: NDArray[np.uint8] | NDArray[np.uint16]) -> None:
    """Write a PNG, JPEG or TIFF, by the path's ending: (rows, cols) or (rows, cols, 3) RGB."""
    path = Path(path)
    check_writable(path, endings=PICTURES if pixels.dtype == np.uint8 else LABEL_IMAGES)
    image = cv2.cvtColor(pixels, cv2.COLOR_RGB2BGR) if pixels.ndim == 3 else pixels
    write_bytes(path, cv2.imencode(path.suffix.lower(), image)[1].tobytes())


def decode(path: Path, *, what: str) -> NDArray[np.generic]:
    """The pixels of an image file as they are stored; a palette becomes its colours.

    Raises InputError where the file is missing, cut or no image.
    """
    data = read_bytes(path, what=what)
    try:
        if data[:4] in (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"):
            return _first_page(data)
        return _picture(data)
    except Exception as error:
        found = " ".join(str(error).split()).replace("<_io.BytesIO object", "<data")
        if "cannot identify" in found:
            found = "none of these"
        raise InputError(f"{path}: expected {what}, found {found}") from None


def _first_page(data: bytes) -> NDArray[np.generic]:
    import tifffile  # noqa: PLC0415 - other images do without its 20 ms

    with tifffile.TiffFile(io.BytesIO(data)) as file:
        if len(file.series) > 1 or len(file.series[0].pages) > 1:
            raise ValueError(f"{len(file.pages)} pages")
        page = file.pages.first
        packed = page.compression not in (1, 8, 32946, 32773)  # what tifffile unpacks by itself
        if packed or page.photometric in (PALETTE, WHITE_IS_ZERO):
            return _picture(data)
        pixels = np.asarray(page.asarray())
    planes = pixels.ndim == 3 and page.planarconfig == SEPARATE_PLANES
    return np.moveaxis(pixels, 0, -1) if planes else pixels


def _picture(data: bytes) -> NDArray[np.generic]:
    with warnings.catch_warnings():
        warnings.simplefilter("error", Image.DecompressionBombWarning)
        with Image.open(io.BytesIO(data)) as picture:
            picture.load()
            if picture.mode in ("P", "PA", "CMYK", "YCbCr", "LAB", "HSV"):
                return np.asarray(picture.convert("RGB"))
            if picture.mode == "1":
                return np.asarray(picture.convert("L"))
            return np.asarray(picture)
