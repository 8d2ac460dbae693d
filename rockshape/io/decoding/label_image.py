"""Label images: whole numbers (rows, cols), a rock's id in each of its pixels and 0 elsewhere."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.io.decoding.mask_stack import stack_instances
from rockshape.rock.grey_levels import grey_levels
from rockshape.rock.instances import MAX_ID, Instances
from rockshape.rock.pieces import split_pieces

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.io.format import ImageInfo

MAX_UINT16 = 2**16 - 1


def instances_of(file: "InputFile", labels: NDArray[Any], info: "ImageInfo") -> Instances:
    """Instances of an array: a label image, or a stack of masks where it has three dimensions.

    Floats are read where they are whole. A single value in several pieces is a mask without ids,
    see `split_pieces`.
    Raises: InputError for anything but whole numbers of at least 0, and for grey levels.
    """
    if labels.ndim == 3 and 1 not in labels.shape:
        return stack_instances(file, _planes(labels, info), info)
    numbers = labels.squeeze() if labels.ndim == 3 else labels
    if numbers.ndim != 2:
        raise InputError(
            f"{file.path}: expected a label image, (rows, cols) of whole numbers with 0 the "
            f"ground, found {labels.shape} of {labels.dtype}"
        )
    ids = _whole(file, numbers)
    picture = grey_levels(ids)
    if picture is not None:
        raise InputError(f"{file.path}: {picture}")
    return split_pieces(Instances.from_labels(ids), info.pieces)


def _planes(labels: NDArray[Any], info: "ImageInfo") -> NDArray[Any]:
    """Masks (n, rows, cols) of an array that has them first or last."""
    first = labels.shape[1:] == info.shape or labels.shape[:2] != info.shape
    return labels if first else np.moveaxis(labels, 2, 0)


def _whole(file: "InputFile", labels: NDArray[Any]) -> NDArray[np.integer]:
    if labels.dtype == bool:
        return labels.view(np.uint8)
    if labels.dtype.kind == "f":
        if np.isnan(labels).any():
            raise InputError(
                f"{file.path}: expected a label image of whole numbers with 0 the ground, "
                f"found {np.count_nonzero(np.isnan(labels))} pixels that are not a number (NaN)"
            )
        if not (np.isfinite(labels).all() and (np.rint(labels) == labels).all()):
            raise InputError(
                f"{file.path}: expected a label image of whole numbers, found fractions of "
                f"{labels.dtype}"
            )
    elif labels.dtype.kind not in "iu":
        raise InputError(f"{file.path}: expected whole numbers, found {labels.dtype}")
    if labels.size and (labels.min() < 0 or labels.max() > MAX_ID):
        raise InputError(
            f"{file.path}: expected labels from 0 to {MAX_ID}, "
            f"found {labels.min()} to {labels.max()}"
        )
    if labels.dtype.kind in "iu" and labels.dtype != np.uint64:
        return labels
    small = labels.size == 0 or labels.max() < 2**31
    return labels.astype(np.int32 if small else np.int64)


def label_image_16bit(instances: Instances) -> NDArray[np.uint16]:
    """Label image of instances, for a format of 16 bits.

    Raises: InputError where an id is not in 1..65535, or rocks overlap: a label image holds one
    rock a pixel.
    """
    wrong = next((each.id for each in instances if not 0 < each.id <= MAX_UINT16), None)
    if wrong is not None:
        raise InputError(f"expected ids from 1 to {MAX_UINT16} in a label image, found {wrong}")
    labels = np.zeros(instances.shape, dtype=np.uint16)
    for each in instances:
        under = labels[each.window][each.mask]
        if under.any():
            raise InputError(
                f"expected rocks that do not overlap in a label image, found "
                f"{under[under > 0][0]} and {each.id} sharing {np.count_nonzero(under)} pixels"
            )
        labels[each.window][each.mask] = each.id
    return labels
