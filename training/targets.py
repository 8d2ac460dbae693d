"""What the network is to answer at each pixel of a labelled picture."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.segmentation.by_network.answer import NARROWEST_PX, WIDEST_PX, width_code

Singles = NDArray[np.float32]
_TINIEST_PX = 5.0  # a narrower rock is neither rock nor ground


@dataclass(frozen=True, eq=False)
class Targets:
    """Answers (rows, cols) and where they count."""

    rock: Singles  # 1 on rocks
    border: Singles  # 1 within a pixel of another rock or the ground
    distance: Singles  # to the border, over the greatest in the rock; 0 on the ground
    width: Singles  # code of the rock's width
    counts: Singles  # 0 on rocks that are too small


def targets_of(labels: NDArray[np.uint16]) -> Targets:
    """Answers for labels (rows, cols), 0 where no rock is."""
    rock = labels > 0
    edge = _edges(labels)
    inside = (rock & ~edge).astype(np.uint8)
    depth = cv2.distanceTransform(inside, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    distance = np.asarray(depth + 0.5 * rock, dtype=np.float32)
    greatest = np.zeros(int(labels.max()) + 1, dtype=np.float32)
    np.maximum.at(greatest, labels.ravel(), distance.ravel())
    width = 2.0 * greatest[labels]
    thin = rock & (width < _TINIEST_PX)
    border = cv2.dilate(edge.astype(np.uint8), np.ones((2, 2), np.uint8)) > 0
    return Targets(
        rock=rock.astype(np.float32),
        border=border.astype(np.float32),
        distance=np.asarray(distance / np.maximum(greatest[labels], 0.5), dtype=np.float32),
        width=width_code(np.clip(width, NARROWEST_PX, WIDEST_PX)).astype(np.float32),
        counts=(~thin).astype(np.float32),
    )


def _edges(labels: NDArray[np.uint16]) -> NDArray[np.bool_]:
    """Pixels of a rock with one of its four neighbours outside it, the frame's edge aside."""
    edge = np.zeros(labels.shape, dtype=bool)
    across = labels[:, 1:] != labels[:, :-1]
    down = labels[1:] != labels[:-1]
    edge[:, 1:] |= across
    edge[:, :-1] |= across
    edge[1:] |= down
    edge[:-1] |= down
    return edge
