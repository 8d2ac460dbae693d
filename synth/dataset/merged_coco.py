"""COCO instances of a whole split: one class, image and annotation ids unique in the file."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from synth.dataset.files import read_json

Table = dict[str, Any]

_ROCK = 1  # the one category


def merged_coco(out: Path, scenes: Iterable[str], *, split: str) -> Table:
    """COCO table of a split, from the tables of its scenes, whose paths under `out` are given.

    Ids count from 1. A picture's `file_name` begins at the dataset's folder. Beside COCO's own
    keys an image has `scene` (path) and `view`, an annotation `obj_id` and `instance`, its place
    in scene_gt_shape.json. Pictures without a rock stay, without annotations.
    """
    images: list[Table] = []
    annotations: list[Table] = []
    for scene in scenes:
        table = read_json(out / scene / "scene_gt_coco.json")
        instances = {category["id"]: place for place, category in enumerate(table["categories"])}
        ids = {image["id"]: number for number, image in enumerate(table["images"], len(images) + 1)}
        images += [
            {
                **image,
                "id": ids[image["id"]],
                "file_name": f"{scene}/{image['file_name']}",
                "scene": scene,
                "view": image["id"],
            }
            for image in table["images"]
        ]
        annotations += [
            {
                **annotation,
                "id": number,
                "image_id": ids[annotation["image_id"]],
                "category_id": _ROCK,
                "obj_id": annotation["category_id"],
                "instance": instances[annotation["category_id"]],
            }
            for number, annotation in enumerate(table["annotations"], len(annotations) + 1)
        ]
    return {
        "info": {"description": f"rocks, split {split}"},
        "licenses": [],
        "images": images,
        "categories": [{"id": _ROCK, "name": "rock", "supercategory": "rock"}],
        "annotations": annotations,
    }
