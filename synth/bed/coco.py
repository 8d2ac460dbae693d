"""COCO tables of beds: one class, ids that are unique over all tiles."""

from typing import Any

import numpy as np

from synth.bed.bed import Bed
from synth.dataset.bop import run_lengths
from synth.spec.bed import BedSpec


def tile_record(bed: Bed) -> dict[str, Any]:
    """Annotations of one tile, without ids."""
    rows = []
    for label in bed.rocks["id"]:
        mask = bed.labels == label
        across, down = np.flatnonzero(mask.any(axis=0)), np.flatnonzero(mask.any(axis=1))
        rows.append(
            {
                "label": int(label),
                "area": int(mask.sum()),
                "bbox": [
                    int(across[0]),
                    int(down[0]),
                    int(across[-1] - across[0] + 1),
                    int(down[-1] - down[0] + 1),
                ],
                "segmentation": {"size": list(mask.shape), "counts": run_lengths(mask)},
            }
        )
    return {"tile": bed.index, "conditions": dict(bed.conditions), "annotations": rows}


def coco_tables(records: list[dict[str, Any]], spec: BedSpec) -> dict[str, Any]:
    """COCO tables of one class over all tiles; a grain's `label` is its label."""
    annotations: list[dict[str, Any]] = []
    for record in records:
        for row in record["annotations"]:
            annotations.append(
                {
                    "id": len(annotations) + 1,
                    "image_id": record["tile"] + 1,
                    "category_id": 1,
                    "iscrowd": 0,
                    **row,
                }
            )
    return {
        "info": {"description": f"gravel beds, seed {spec.seed}"},
        "images": [
            {
                "id": record["tile"] + 1,
                "file_name": f"images/{record['tile']:06d}.png",
                "width": spec.width_px,
                "height": spec.height_px,
            }
            for record in records
        ],
        "categories": [{"id": 1, "name": "rock", "supercategory": "rock"}],
        "annotations": annotations,
    }
