"""Stacks of masks: a mask a rock, which may overlap."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.io.decoding.polygons import boxed
from rockshape.rock.instances import Instance, Instances

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.io.format import ImageInfo


def stack_instances(
    file: "InputFile",
    masks: Iterable[NDArray[Any]],
    info: "ImageInfo",
    ids: Sequence[int] | None = None,
) -> Instances:
    """Instances of masks (rows, cols), each 0 but for one value; numbered from 1 if not by ids.

    A mask without a pixel is no rock, and a note counts those.
    Raises: InputError for a mask of another shape or of several values.
    """
    items, empty = [], []
    for index, mask in enumerate(masks):
        number = index + 1 if ids is None else ids[index]
        if mask.shape != info.shape:
            raise InputError(
                f"{file.path}: mask {number}: expected {info.shape} as the image has, "
                f"found {mask.shape}"
            )
        inside = _inside(f"{file.path}: mask {number}", mask)
        box = boxed(inside)
        if box is None:
            empty.append(str(number))
        else:
            items.append(Instance(number, *box))
    note = f"{file.path.name}: {len(empty)} masks without a pixel ({', '.join(empty[:5])})"
    return Instances(info.shape, tuple(items), (note,) if empty else ())


def _inside(where: str, mask: NDArray[Any]) -> NDArray[np.bool_]:
    if mask.dtype.kind not in "biuf":
        raise InputError(f"{where}: expected numbers, found {mask.dtype}")
    inside = mask != 0
    values = mask[inside]
    if values.size and not (values == values[0]).all():
        raise InputError(
            f"{where}: expected a mask, 0 but for one value, found {values.min()} to {values.max()}"
        )
    return np.asarray(inside, dtype=np.bool_)
