"""Rocks cut out of answers that are right."""

import cv2
import numpy as np

from rockshape.segmentation.by_network.answer import Answer
from rockshape.segmentation.by_network.instances import cut_rocks


def _packed(seed: int = 0) -> np.ndarray:
    """Labels of cells of a random Voronoi diagram, some of them ground."""
    rng = np.random.default_rng(seed)
    places = rng.uniform(0, 200, (60, 2))
    rows, cols = np.mgrid[:200, :200]
    nearest = np.argmin(
        (rows[..., None] - places[:, 0]) ** 2 + (cols[..., None] - places[:, 1]) ** 2, axis=-1
    )
    return np.where(nearest % 4 == 0, 0, nearest + 1).astype(np.int32)


def _right_answer(labels: np.ndarray) -> Answer:
    distance = np.zeros(labels.shape, dtype=np.float32)
    width = np.full(labels.shape, 20.0, dtype=np.float32)
    edge = np.zeros(labels.shape, dtype=np.float32)
    for number in np.unique(labels[labels > 0]):
        own = np.pad((labels == number).astype(np.uint8), 1)
        depth = cv2.distanceTransform(own, cv2.DIST_L2, 5)[1:-1, 1:-1]
        distance += depth / depth.max()
        width[labels == number] = 2 * depth.max()
        edge[(depth > 0) & (depth < 1.5)] = 1.0
    return Answer((labels > 0).astype(np.float32), edge, distance, width)


def _iou(one: np.ndarray, two: np.ndarray) -> float:
    return float((one & two).sum() / (one | two).sum())


def test_rocks_that_touch_are_told_apart_and_ground_is_left_out():
    labels = _packed()
    found = cut_rocks(_right_answer(labels))
    numbers, sizes = np.unique(labels[labels > 0], return_counts=True)
    overlaps = []
    for number in numbers[sizes > 100]:
        own = labels == number
        partner = np.bincount(found[own]).argmax()
        overlaps.append(_iou(own, found == partner) if partner > 0 else 0.0)
    # the tip of a wedge belongs to whose core is nearer, and a bent rock may pass for two
    assert np.mean(np.array(overlaps) > 0.5) > 0.9
    assert np.median(overlaps) > 0.95
    assert (found[labels == 0] > 0).mean() < 0.01
    assert len(np.unique(found)) - 1 <= 1.2 * len(numbers)  # a bent rock may have two tops


def test_bare_ground_has_no_rock():
    nothing = np.zeros((50, 60), dtype=np.float32)
    assert not cut_rocks(Answer(nothing, nothing, nothing, nothing + 20.0)).any()
