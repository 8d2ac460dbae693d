"""BOP target lists: which rocks of which images a method is to find."""

from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from synth.dataset.files import read_json

Table = dict[str, Any]

MIN_VISIBLE = 0.1  # least visible fraction of a target, as in the BOP Challenge 2019


def targets_2019(scenes: Iterable[Path]) -> list[Table]:
    """Table of test_targets_bop19.json: object, image, and how often the object is to be found."""
    targets = []
    for scene in scenes:
        poses, infos = (read_json(scene / f"scene_{name}.json") for name in ("gt", "gt_info"))
        for view in poses:
            counts = Counter(
                pose["obj_id"]
                for pose, info in zip(poses[view], infos[view], strict=True)
                if info["visib_fract"] >= MIN_VISIBLE
            )
            targets += [
                {"scene_id": int(scene.name), "im_id": int(view), "obj_id": rock, "inst_count": n}
                for rock, n in sorted(counts.items())
            ]
    return targets


def targets_2024(scenes: Iterable[Path]) -> list[Table]:
    """Table of test_targets_bop24.json: the images alone; what they show is not told."""
    return [
        {"scene_id": int(scene.name), "im_id": int(view)}
        for scene in scenes
        for view in read_json(scene / "scene_gt.json")
    ]


def dataset_info(description: str) -> str:
    """Text of dataset_info.md."""
    return (
        "# Rocks of known shape\n\n"
        f"{description}\n\n"
        "Made with rockshape; `manifest.json` has the specification. Lengths in millimetres. A "
        "model's origin is the middle of its box, z along its shortest side. Pixel coordinates "
        "are those of pixel centres: renderers that count from the frame's corner, as the BOP "
        "toolkit's do, take cx + 0.5 and cy + 0.5.\n"
    )
