"""COCO annotations: polygons and uncompressed run lengths.

Source: the data format of the COCO challenges, https://cocodataset.org/#format-data.
"""

from itertools import pairwise
from math import prod
from typing import TYPE_CHECKING, Annotated

import msgspec
import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.io.format import ImageInfo, LabelFormat
from rockshape.rock.instances import Instance, Instances

if TYPE_CHECKING:
    from rockshape.io.files import InputFile


class _Image(msgspec.Struct):
    id: int
    width: int
    height: int
    file_name: str = ""


class _RunLengths(msgspec.Struct):
    size: tuple[int, int]  # rows, columns
    counts: list[int]  # down the columns, zeros first


class _Annotation(msgspec.Struct):
    id: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)]
    image_id: int
    segmentation: list[list[float]] | _RunLengths


class _Coco(msgspec.Struct):
    images: list[_Image]
    annotations: list[_Annotation]


def read_coco(file: "InputFile", info: ImageInfo) -> Instances:
    """Instances of one image's annotations: each its own mask, with the annotation's id.

    The image is the one in the file whose name ends as the image's does, or the only one. A
    polygon's pixels are those whose centres it holds.

    Raises:
        InputError: the file is no COCO, has no such image or one of another size, or ids repeat.
    """
    try:
        coco = msgspec.json.decode(file.data, type=_Coco)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise InputError(
            f"{file.path}: expected COCO annotations (JSON with images and annotations), "
            f"found: {error}"
        ) from None
    image = _choose(file, coco.images, info.name)
    if (image.height, image.width) != info.shape:
        raise InputError(
            f"{file.path}: expected {info.shape} as the image has, "
            f"found {(image.height, image.width)}"
        )
    annotations = sorted(
        (each for each in coco.annotations if each.image_id == image.id), key=lambda each: each.id
    )
    for first, second in pairwise(annotations):
        if first.id == second.id:
            raise InputError(f"{file.path}: expected ids that differ, found {first.id} twice")
    items = (_instance(file, each, info.shape) for each in annotations)
    return Instances(info.shape, tuple(each for each in items if each is not None))


def _choose(file: "InputFile", images: list[_Image], name: str) -> _Image:
    named = [
        each for each in images if each.file_name.replace("\\", "/").rpartition("/")[2] == name
    ]
    if len(named) == 1:
        return named[0]
    if len(images) == 1:
        return images[0]
    raise InputError(f"{file.path}: expected one image named {name}, found {len(named)}")


def _instance(
    file: "InputFile", annotation: _Annotation, shape: tuple[int, int]
) -> Instance | None:
    """Mask of an annotation in the box of its pixels; None where it has none."""
    where = f"{file.path}: annotation {annotation.id}"
    if isinstance(annotation.segmentation, _RunLengths):
        rows, cols = _run_pixels(where, annotation.segmentation, shape)
    else:
        rows, cols = _polygon_pixels(where, annotation.segmentation, shape)
    if not len(rows):
        return None
    top, left = int(rows.min()), int(cols.min())
    mask = np.zeros((int(rows.max()) + 1 - top, int(cols.max()) + 1 - left), dtype=bool)
    mask[rows - top, cols - left] = True
    window = slice(top, top + mask.shape[0]), slice(left, left + mask.shape[1])
    return Instance(annotation.id, window, mask)


def _run_pixels(
    where: str, runs: _RunLengths, shape: tuple[int, int]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns of the pixels that run lengths cover."""
    if runs.size != shape or min(runs.counts, default=0) < 0 or sum(runs.counts) != prod(shape):
        raise InputError(f"{where}: expected run lengths over {shape}")
    covered = np.repeat(np.arange(len(runs.counts)) % 2 == 1, runs.counts)
    cols, rows = np.divmod(np.flatnonzero(covered), shape[0])
    return rows, cols


def _polygon_pixels(
    where: str, polygons: list[list[float]], shape: tuple[int, int]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns of the pixels whose centres lie in any of the polygons."""
    import skimage.draw  # noqa: PLC0415 - takes longer to import than other labels to be read

    parts = []
    for polygon in polygons:
        if len(polygon) < 6 or len(polygon) % 2:
            raise InputError(f"{where}: expected polygons of three points or more")
        # COCO's corners are pixel corners: half a pixel before the centres
        x, y = np.array(polygon).reshape(-1, 2).T - 0.5
        parts.append(skimage.draw.polygon(y, x, shape=shape))
    rows, cols = np.hstack(parts) if parts else np.empty((2, 0), dtype=np.intp)
    return rows, cols


FORMAT = LabelFormat(
    name="COCO",
    suffixes=(".json",),
    summary="JSON with polygons or uncompressed run lengths; rocks may overlap",
    read=read_coco,
)
