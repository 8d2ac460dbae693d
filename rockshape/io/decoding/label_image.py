"""Label images: whole numbers (rows, cols), a rock's id in each of its pixels and 0 elsewhere."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.rock.instances import MAX_LABEL, Instances

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

MAX_UINT16 = 2**16 - 1


def instances_of(file: "InputFile", labels: NDArray[np.generic]) -> Instances:
    """Instances of a label image that a file holds.

    Raises: InputError for anything but a grey image of whole numbers from 0 to 2147483647.
    """
    if labels.ndim != 2 or not np.issubdtype(labels.dtype, np.integer):
        raise InputError(
            f"{file.path}: expected a label image, (rows, cols) of whole numbers with 0 the "
            f"ground, found {labels.shape} of {labels.dtype}"
        )
    if labels.size and (labels.min() < 0 or labels.max() > MAX_LABEL):
        raise InputError(
            f"{file.path}: expected labels from 0 to {MAX_LABEL}, "
            f"found {labels.min()} to {labels.max()}"
        )
    return Instances.from_labels(labels.astype(np.int32))


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
