"""Answers at several scales joined into one: each place is answered where its rocks fit best."""

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Singles
from rockshape.segmentation.by_network.answer import Answer
from rockshape.segmentation.by_network.network import answer_of

SCALES = (1.0, 0.5, 0.25)
_SMALLEST_PX = 48  # a picture is not reduced below this side
_BEST_PX = 32.0  # width of a rock, at its scale, that is answered best
_TOLERANCE = 0.8  # standard deviation of the logarithm to base 2 of other widths


def joint_answer(picture: Singles) -> Answer:
    """Answer for a picture (rows, cols[, 3]) from all scales that its size allows."""
    rows, cols = picture.shape[:2]
    scales = [scale for scale in SCALES if scale == 1.0 or scale * min(rows, cols) >= _SMALLEST_PX]
    answers = [_at_scale(picture, scale) for scale in scales]
    weights = _weights([one.width_px for one in answers], scales)
    joint = [
        sum(weight * getattr(one, name) for weight, one in zip(weights, answers, strict=True))
        for name in ("rock", "border", "distance", "width_px")
    ]
    return Answer(*joint)


def _at_scale(picture: Singles, scale: float) -> Answer:
    """Answer at a scale, as maps of the whole picture; widths are those in the whole picture."""
    if scale == 1.0:
        return answer_of(picture)
    rows, cols = picture.shape[:2]
    size = max(1, round(cols * scale)), max(1, round(rows * scale))
    reduced = cv2.resize(picture, size, interpolation=cv2.INTER_AREA)
    small = answer_of(np.asarray(reduced, dtype=np.float32))

    def whole(values: Singles) -> Singles:
        return np.asarray(cv2.resize(values, (cols, rows), interpolation=cv2.INTER_LINEAR))

    return Answer(
        whole(small.rock),
        whole(small.border),
        whole(small.distance),
        whole(small.width_px) / np.float32(scale),
    )


def _weights(widths_px: list[Singles], scales: list[float]) -> list[NDArray[np.float32]]:
    """Weight (rows, cols) of each scale; they sum to 1."""
    logs = []
    for width_px, scale in zip(widths_px, scales, strict=True):
        off = np.log2(width_px * np.float32(scale / _BEST_PX))
        if scale == max(scales):
            off = np.maximum(off, 0.0)
        if scale == min(scales):
            off = np.minimum(off, 0.0)
        logs.append(-0.5 * (off / np.float32(_TOLERANCE)) ** 2)
    greatest = np.maximum.reduce(logs)
    shares = [np.exp(log - greatest) for log in logs]
    total = np.add.reduce(shares)
    return [np.asarray(share / total, dtype=np.float32) for share in shares]
