"""COCO annotations of a data set: polygons and run lengths.

Source: the data format of the COCO challenges, https://cocodataset.org/#format-data; SA-1B's files
of one image, whose annotations name none.
"""

import json
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any

import numpy as np

from rockshape.errors import InputError
from rockshape.io.decoding.coco_masks import entry_of
from rockshape.io.decoding.json_text import as_number, load_json
from rockshape.io.decoding.outlined import collect
from rockshape.io.encoding.pixel_rings import pixel_rings, signed_area
from rockshape.io.format import ImageInfo, LabelFormat

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instance, Instances

EXPECTED = "COCO annotations (JSON with images and annotations)"


def read_coco(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of one image's annotations: each its own mask, with the annotation's id.

    The image is the one whose name ends as the image's does, or the only one. A polygon's pixels
    are those whose centres it holds. Crowds are left out, and so is what cannot be read; a note
    counts them. Whatever belongs to another image is not looked at.
    Raises: InputError: the file is no COCO, has no such image or one of another size, ids repeat,
        or run lengths are damaged.
    """
    coco = load_json(file, EXPECTED)
    if not isinstance(coco, dict) or not isinstance(coco.get("annotations"), list):
        raise InputError(f"{file.path}: expected {EXPECTED}, found {_found(coco)}")
    image = _choose(file, _images(coco), info)
    size = (as_number(image.get("height")), as_number(image.get("width")))
    if None not in size and size != info.shape:
        raise InputError(f"{file.path}: expected {info.shape} as the image has, found {size}")
    own = [each for each in coco["annotations"] if _belongs(each, image)]
    entries = [entry_of(file, each, info.shape) for each in own]
    return collect(file, info, entries, noun="annotation")


def _images(coco: dict[str, Any]) -> list[dict[str, Any]]:
    images = coco.get("images", coco.get("image"))
    listed = images if isinstance(images, list) else [images]
    return [each for each in listed if isinstance(each, dict)]


def _belongs(annotation: object, image: dict[str, Any]) -> bool:
    """Whether an annotation is of an image; SA-1B's name none."""
    if not isinstance(annotation, dict):
        return False
    number = image.get("id", image.get("image_id"))
    return str(annotation.get("image_id", number)) == str(number)


def _choose(file: "InputFile", images: list[dict[str, Any]], info: ImageInfo) -> dict[str, Any]:
    """The image by its name, with or without its suffix, else the only one."""
    names = [PurePosixPath(str(each.get("file_name", "")).replace("\\", "/")) for each in images]
    wanted = PurePosixPath(info.name)
    for found in (
        [each for each, name in zip(images, names, strict=True) if name.name == wanted.name],
        [each for each, name in zip(images, names, strict=True) if name.stem == wanted.stem],
    ):
        fitting = [each for each in found if (each.get("height"), each.get("width")) == info.shape]
        for choice in (found, fitting):
            if info.name and len(choice) == 1:
                return choice[0]
    if len(images) == 1:
        return images[0]
    some = ", ".join(str(name) for name in names[:3])
    raise InputError(
        f"{file.path}: expected one image named {info.name}, "
        f"found {sum(name.name == wanted.name for name in names)} of {len(names)} ({some}, ...)"
    )


def _found(content: object) -> str:
    if isinstance(content, dict):
        return f"an object with {', '.join(map(str, list(content)[:5])) or 'nothing'}"
    return f"a JSON {type(content).__name__}"


def write_coco(instances: "Instances") -> bytes:
    """COCO of one image and one class, `rock`; the mask is told exactly.

    A rock's segmentation is polygons of pixel corners, or run lengths where it has a hole.
    """
    rows, cols = instances.shape
    content = {
        "images": [{"id": 1, "width": cols, "height": rows, "file_name": ""}],
        "categories": [{"id": 1, "name": "rock"}],
        "annotations": [_annotation(each, (rows, cols)) for each in instances],
    }
    return json.dumps(content).encode()


def _annotation(instance: "Instance", shape: tuple[int, int]) -> dict[str, Any]:
    rows, cols = instance.window
    corner = cols.start, rows.start
    rings = pixel_rings(instance.mask)
    segmentation: Any = [(ring + corner).ravel().tolist() for ring in rings]
    if any(signed_area(ring) < 0 for ring in rings):
        whole = np.zeros(shape, dtype=bool)
        whole[instance.window] = instance.mask
        segmentation = {"size": list(shape), "counts": _run_lengths(whole)}
    return {
        "id": instance.id,
        "image_id": 1,
        "category_id": 1,
        "segmentation": segmentation,
        "area": int(np.count_nonzero(instance.mask)),
        "bbox": [*corner, cols.stop - cols.start, rows.stop - rows.start],
        "iscrowd": 0,
    }


def _run_lengths(mask: "NDArray[np.bool_]") -> list[int]:
    """Lengths of the runs down the columns, that of the ground first."""
    values = mask.ravel(order="F")
    starts = np.flatnonzero(np.diff(values, prepend=False))
    lengths: list[int] = np.diff(starts, prepend=0, append=mask.size).tolist()
    return lengths


FORMAT = LabelFormat(
    name="COCO",
    suffixes=(".json",),
    summary="JSON with images and annotations: polygons, run lengths; no crowds",
    tested_with="pycocotools, COCO data format",
    read=read_coco,
    write=write_coco,
)
