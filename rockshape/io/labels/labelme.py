"""LabelMe annotations of one image.

Source: labelme 5, labelme/label_file.py and labelme/utils/shape.py.
"""

import base64
import binascii
import io
import re
from typing import TYPE_CHECKING, Any

import numpy as np

from rockshape.errors import InputError
from rockshape.io.decoding.ellipses import ellipse_mask
from rockshape.io.decoding.json_text import as_number, load_json
from rockshape.io.decoding.outlined import Entry, UnreadableError, collect, polygons_mask, union
from rockshape.io.decoding.polygons import BoxedMask, boxed
from rockshape.io.format import ImageInfo, LabelFormat

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instances

EXPECTED = "LabelMe annotations (JSON with shapes)"
_SHAPES = re.compile(rb'(\xef\xbb\xbf)?\s*\{.*"shapes"\s*:', re.DOTALL)


def is_labelme(head: bytes) -> bool:
    """Whether content is an object with LabelMe's shapes."""
    return bool(_SHAPES.match(head))


def read_labelme(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of polygons, rectangles, circles and masks, numbered from 1 in the file's order.

    Shapes of one label that share a group_id are pieces of one rock. Points and lines are left
    out, and a note counts them.
    Raises: InputError where the file is no LabelMe or of an image of another size.
    """
    content = load_json(file, EXPECTED)
    if not isinstance(content, dict) or not isinstance(content.get("shapes"), list):
        raise InputError(f"{file.path}: expected {EXPECTED}, found other JSON")
    size = as_number(content.get("imageHeight")), as_number(content.get("imageWidth"))
    if None not in size and size != info.shape:
        raise InputError(f"{file.path}: expected {info.shape} as the image has, found {size}")
    rocks: dict[object, list[Any]] = {}
    for index, shape in enumerate(content["shapes"]):
        told = shape if isinstance(shape, dict) else {}
        group = told.get("group_id")
        key = index if group is None else (str(told.get("label")), str(group))
        rocks.setdefault(key, []).append(told)
    return collect(
        file, info, [_entry(file, pieces, info) for pieces in rocks.values()], noun="shape"
    )


def _entry(file: "InputFile", pieces: list[dict[str, Any]], info: ImageInfo) -> Entry:
    return Entry(None, lambda: union([_mask(file, piece, info) for piece in pieces]))


def _mask(file: "InputFile", shape: dict[str, Any], info: ImageInfo) -> BoxedMask | None:
    kind, points = shape.get("shape_type") or "polygon", shape.get("points")
    if kind == "polygon":
        return polygons_mask([[points]], info.shape)
    if kind not in ("rectangle", "circle", "mask"):
        raise UnreadableError(f"of kind {kind}")
    try:
        first, second = np.asarray(points, dtype=np.float64).reshape(2, 2)
    except (TypeError, ValueError):
        raise UnreadableError(f"{kind} without two points") from None
    if kind == "circle":
        radius = float(np.hypot(*(second - first)))
        return ellipse_mask(first, (radius, radius), info.shape)
    if kind == "mask":
        return _stored_mask(file, shape.get("mask"), first, info)
    (x0, y0), (x1, y1) = first, second
    return polygons_mask([[[(x0, y0), (x1, y0), (x1, y1), (x0, y1)]]], info.shape)


def _stored_mask(
    file: "InputFile", text: object, corner: np.ndarray[Any, Any], info: ImageInfo
) -> BoxedMask | None:
    """Pixels of a PNG in base64 whose first pixel is at a corner (x, y)."""
    from rockshape.io.decoding.pillow import open_picture  # noqa: PLC0415 - rarely needed

    try:
        data = base64.b64decode(str(text), validate=True)
        with open_picture(file, io.BytesIO(data), ("PNG",)) as picture:
            found = np.asarray(picture) != 0
    except (binascii.Error, OSError, SyntaxError):
        raise UnreadableError("mask that is no PNG") from None
    rows, cols = info.shape
    left, top = (int(each) for each in np.clip(np.rint(corner), 0, (cols, rows)))
    return boxed(found[: rows - top, : cols - left], top, left)


FORMAT = LabelFormat(
    name="LabelMe",
    suffixes=(".json",),
    summary="polygons, rectangles, circles and masks of one image, which may overlap",
    tested_with="labelme 5 label_file.py",
    sniff=is_labelme,
    read=read_labelme,
)
