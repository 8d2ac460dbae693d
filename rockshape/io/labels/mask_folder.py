"""Folders of masks, a file a rock."""

import re
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.io.decoding.mask_stack import stack_instances
from rockshape.io.decoding.numpy_files import NPY_MAGIC, load_npy
from rockshape.io.decoding.pillow import read_numbers
from rockshape.io.decoding.raster import PNG_MAGIC, TIFF_MAGIC, decode_picture, decode_tiff
from rockshape.io.files import InputFile
from rockshape.io.format import ImageInfo, LabelFormat

if TYPE_CHECKING:
    from rockshape.rock.instances import Instances

SUFFIXES = (".png", ".tif", ".tiff", ".bmp", ".npy")
LOSSY = (".jpg", ".jpeg", ".webp")
_NUMBER = re.compile(r"(\d+)$")


def read_folder(file: InputFile, info: ImageInfo) -> "Instances":
    """Instances of the PNG, TIFF, BMP and NPY masks of a folder, in the order of their names.

    Ids are the numbers that the names end in, if all do and differ; else they count from 1. Other
    files are not looked at.
    Raises: InputError for a folder without masks or with lossy pictures, and for a mask of another
        shape or of several values.
    """
    paths = sorted((each for each in file.path.iterdir() if each.is_file()), key=_natural)
    lossy = [each.name for each in paths if each.suffix.lower() in LOSSY]
    if lossy:
        raise InputError(f"{file.path}: expected masks without loss, PNG say, found {lossy[0]}")
    masks = [each for each in paths if each.suffix.lower() in SUFFIXES]
    if not masks:
        raise InputError(f"{file.path}: expected masks ({', '.join(SUFFIXES)}), found none")
    files = (replace(file, path=path, expected="a mask") for path in masks)
    return stack_instances(file, map(_mask, files), info, _ids(masks))


def _ids(paths: list[Path]) -> list[int] | None:
    found = [_NUMBER.search(path.stem) for path in paths]
    numbers = [int(each[1]) for each in found if each is not None]
    fit = len(set(numbers)) == len(paths) and max(numbers) < 2**63
    return numbers if fit else None


def _natural(path: Path) -> tuple[str, int, str]:
    number = _NUMBER.search(path.stem)
    start = path.stem if number is None else path.stem[: number.start()]
    return start, -1 if number is None else int(number[1]), path.name


def _mask(file: InputFile) -> NDArray[Any]:
    if file.head.startswith(PNG_MAGIC):
        return decode_picture(file)
    if file.head.startswith(TIFF_MAGIC):
        return decode_tiff(file)
    if file.head.startswith(NPY_MAGIC):
        return load_npy(file)
    return read_numbers(file, "BMP")


FORMAT = LabelFormat(
    name="mask folder",
    suffixes=(),
    summary="folder of a PNG, TIFF, BMP or NPY mask a rock, which may overlap; a number at the end "
    "of a name is its id",
    tested_with="Pillow, tifffile, NumPy",
    folder=True,
    read=read_folder,
)
