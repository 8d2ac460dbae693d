"""Segmentations as COCO has them: polygons, or run lengths plain or compressed.

Source: the data format of the COCO challenges, https://cocodataset.org/#format-data.
"""

from typing import TYPE_CHECKING, Any

from rockshape.errors import InputError
from rockshape.io.decoding.outlined import CROWD, Entry, UnreadableError, polygons_mask
from rockshape.io.decoding.polygons import BoxedMask
from rockshape.io.decoding.run_lengths import decode_run_lengths

if TYPE_CHECKING:
    from rockshape.io.files import InputFile


def entry_of(file: "InputFile", annotation: dict[str, Any], shape: tuple[int, int]) -> Entry:
    """Entry of an annotation or a detection, with its own id where it has one."""
    number = annotation.get("id")
    if annotation.get("iscrowd"):
        return Entry(number, _crowd)
    where = f"{file.path}: annotation {number}" if number is not None else f"{file.path}"
    return Entry(number, lambda: _mask(where, annotation.get("segmentation"), shape))


def _crowd() -> None:
    raise UnreadableError(CROWD)


def _mask(where: str, segmentation: object, shape: tuple[int, int]) -> BoxedMask | None:
    """Pixels of a segmentation.

    Raises: UnreadableError for none, InputError for run lengths that are damaged or of another
        image.
    """
    if isinstance(segmentation, dict):
        size = segmentation.get("size")
        if not isinstance(size, list) or tuple(size) != shape:
            raise InputError(f"{where}: expected run lengths over {shape}, found {size}")
        try:
            return decode_run_lengths(segmentation.get("counts"), shape)
        except ValueError as error:
            raise InputError(f"{where}: expected run lengths over {shape}, found {error}") from None
    if not isinstance(segmentation, list):
        raise UnreadableError("without segmentation")
    flat = bool(segmentation) and not isinstance(segmentation[0], list)
    lists = [segmentation] if flat else segmentation
    return polygons_mask([[_corners(each)] for each in lists], shape)


def _corners(numbers: object) -> object:
    """Corners (x, y) of a list of x, y, x, y, …, which are pixel corners; else as it is."""
    if not isinstance(numbers, list) or len(numbers) % 2:
        return None
    return list(zip(numbers[::2], numbers[1::2], strict=True))
