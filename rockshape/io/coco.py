"""Rocks outlined in COCO's JSON: polygons and run lengths become a label image."""

from pathlib import Path

import msgspec
import numpy as np
import skimage.draw
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.io.files import read_bytes

WHAT = "COCO annotations (JSON with images and annotations)"


class _Image(msgspec.Struct):
    id: int
    width: int
    height: int
    file_name: str = ""


class _RunLengths(msgspec.Struct):
    size: tuple[int, int]  # rows, columns
    counts: list[int]  # down the columns, zeros first


class _Annotation(msgspec.Struct):
    id: int
    image_id: int
    segmentation: list[list[float]] | _RunLengths


class _Coco(msgspec.Struct):
    images: list[_Image]
    annotations: list[_Annotation]


def read_coco(path: Path, *, image_name: str, shape: tuple[int, ...]) -> NDArray[np.int32]:
    """Label image (rows, cols) of one image's annotations; a rock's number is its annotation's id.

    The image is the one in the file whose name ends as image_name does, or the only one. Later
    annotations cover earlier ones. A polygon's pixels are those whose centres it holds.
    Raises InputError where the file is no COCO, has no such image or one of another size.
    """
    try:
        coco = msgspec.json.decode(read_bytes(path, what=WHAT), type=_Coco)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: expected {WHAT}, found: {error}") from None
    image = _choose(path, coco.images, image_name)
    if (image.height, image.width) != shape[:2]:
        raise InputError(
            f"{path}: expected {shape[:2]} as the image has, found {(image.height, image.width)}"
        )
    labels = np.zeros(shape[:2], dtype=np.int32)
    for annotation in coco.annotations:
        if annotation.image_id == image.id:
            labels[_mask(path, annotation, shape)] = annotation.id
    return labels


def _choose(path: Path, images: list[_Image], image_name: str) -> _Image:
    named = [image for image in images if Path(image.file_name).name == image_name]
    if len(named) == 1:
        return named[0]
    if len(images) == 1:
        return images[0]
    raise InputError(f"{path}: expected one image named {image_name}, found {len(named)}")


def _mask(path: Path, annotation: _Annotation, shape: tuple[int, ...]) -> NDArray[np.bool_]:
    where = f"{path}: annotation {annotation.id}"
    if annotation.id <= 0:
        raise InputError(f"{where}: expected a positive id")
    outline = annotation.segmentation
    if isinstance(outline, _RunLengths):
        rows, cols = outline.size
        if (rows, cols) != shape[:2] or sum(outline.counts) != rows * cols:
            raise InputError(f"{where}: expected run lengths over {shape[:2]}")
        values = np.arange(len(outline.counts)) % 2 == 1
        return np.repeat(values, outline.counts).reshape(cols, rows).T
    mask = np.zeros(shape[:2], dtype=bool)
    for polygon in outline:
        if len(polygon) < 6 or len(polygon) % 2:
            raise InputError(f"{where}: expected polygons of three points or more")
        # COCO's corners are pixel corners: half a pixel before the centres
        x, y = np.array(polygon).reshape(-1, 2).T - 0.5
        mask[skimage.draw.polygon(y, x, shape=shape[:2])] = True
    return mask
