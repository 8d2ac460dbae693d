"""Masks without ids: one value whose connected pieces are the rocks."""

from typing import Literal, get_args

import cv2
import numpy as np

from rockshape.errors import unknown_name
from rockshape.rock.instances import Instance, Instances

Pieces = Literal["split", "keep"]
"""What becomes of a label image with one value in several pieces: a rock each, or one rock."""


def split_pieces(instances: Instances, pieces: Pieces = "split") -> Instances:
    """Rocks of a label image; a single one in several pieces (8-connected) becomes a rock each.

    The pieces are numbered from 1 in reading order, and a note says so. `keep` keeps the rock.
    Raises: InputError where pieces is neither.
    """
    if pieces not in get_args(Pieces):
        raise unknown_name("pieces", pieces, get_args(Pieces))
    if len(instances) != 1 or pieces == "keep":
        return instances
    (whole,) = instances
    count, parts, stats, _ = cv2.connectedComponentsWithStats(
        np.ascontiguousarray(whole.mask).view(np.uint8), connectivity=8
    )
    if count <= 2:
        return instances
    # reading order: by the first pixel
    _, first = np.unique(parts, return_index=True)
    order = 1 + np.argsort(first[1:])
    top, left = whole.window[0].start, whole.window[1].start
    items = []
    for number, part in enumerate(order.tolist(), start=1):
        x, y, width, height = stats[part, : cv2.CC_STAT_AREA].tolist()
        window = slice(top + y, top + y + height), slice(left + x, left + x + width)
        items.append(Instance(number, window, parts[y : y + height, x : x + width] == part))
    note = (
        f"labels: one value ({whole.id}) in {len(items)} pieces is a mask without ids: "
        f"each piece is a rock (--pieces keep: all are one)"
    )
    return Instances(instances.shape, tuple(items), (*instances.notes, note))
