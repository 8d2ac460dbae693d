"""Lists of detections: COCO's results and the masks of Segment Anything.

Source: the results format of the COCO challenges, https://cocodataset.org/#format-results; the
output of segment_anything's SamAutomaticMaskGenerator, `output_mode="coco_rle"`.
"""

import re
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any

from rockshape.errors import InputError
from rockshape.io.decoding.coco_masks import entry_of
from rockshape.io.decoding.json_text import load_json
from rockshape.io.decoding.outlined import collect
from rockshape.io.format import ImageInfo, LabelFormat

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instances

EXPECTED = "a list of detections with segmentations"
_LIST = re.compile(rb"(\xef\xbb\xbf)?\s*\[\s*(\{|\])")


def is_sam(head: bytes) -> bool:
    """Whether content is a list of Segment Anything's masks."""
    return bool(_LIST.match(head)) and b'"predicted_iou"' in head


def is_results(head: bytes) -> bool:
    """Whether content is a list of detections."""
    return bool(_LIST.match(head)) and b'"Feature"' not in head


def read_detections(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of a list of detections; they are numbered from 1 where they have no id.

    Where the list is of several images, those whose image_id is the image's name count.
    Raises: InputError where the file is no such list or none of several images is named so.
    """
    listed = load_json(file, EXPECTED)
    if not isinstance(listed, list) or not all(isinstance(each, dict) for each in listed):
        raise InputError(f"{file.path}: expected {EXPECTED}, found other JSON")
    own = _of_image(file, listed, info)
    entries = [entry_of(file, each, info.shape) for each in own]
    return collect(file, info, entries, noun="detection")


def _of_image(
    file: "InputFile", detections: list[dict[str, Any]], info: ImageInfo
) -> list[dict[str, Any]]:
    images = {str(each.get("image_id")) for each in detections}
    if len(images) < 2:
        return detections
    name = PurePosixPath(info.name)
    for wanted in (name.name, name.stem, name.stem.lstrip("0")):
        if wanted in images:
            return [each for each in detections if str(each.get("image_id")) == wanted]
    raise InputError(
        f"{file.path}: expected detections of one image, or with image_id {name.stem}, "
        f"found {len(images)} images"
    )


SAM = LabelFormat(
    name="Segment Anything",
    suffixes=(".json",),
    summary="list of SAM's masks as run lengths (`coco_rle`), which may overlap",
    tested_with="pycocotools, keys of SamAutomaticMaskGenerator",
    sniff=is_sam,
    read=read_detections,
)
RESULTS = LabelFormat(
    name="COCO results",
    suffixes=(".json",),
    summary="list of detections with polygons or run lengths, which may overlap",
    tested_with="pycocotools",
    sniff=is_results,
    read=read_detections,
)
