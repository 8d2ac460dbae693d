"""Labels whose borders are the image's edges."""

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.robust_scale import MEDIAN_TO_SIGMA
from rockshape.segmentation.brightness import blurred_light
from rockshape.segmentation.by_range.height_signal import HeightSignal
from rockshape.segmentation.edges.edge_snapping import BLUR_PX, SnappedOutline, paint, snap

MIN_TEXTURE = 1e-3


def texture_of(image: NDArray[np.float32]) -> float:
    """Scatter of the slope of the image's logarithm, 1/px: the texture of most of the frame."""
    slope = cv2.Sobel(blurred_light(image, BLUR_PX), cv2.CV_32F, 1, 0, scale=0.125)
    slope = np.abs(slope[::2, ::2])
    return max(MIN_TEXTURE, MEDIAN_TO_SIGMA * float(np.median(slope)))


def snapped(
    image: NDArray[np.float32],
    labels: NDArray[np.int32],
    relief: HeightSignal | None,
    *,
    texture: float,
    window_px: int,
) -> tuple[dict[int, SnappedOutline], NDArray[np.int32]]:
    """Outlines moved to the image's edges and the labels they enclose, nearer rocks over farther.

    texture is that of `texture_of`, window_px the side of the window over which errors of range
    correlate, 1 without range.
    Where range's outlines lie on the image's edges already, no outline is given and the labels are
    left as they are.
    """
    outlines = snap(image, labels, texture=texture, window_px=window_px)
    if not outlines:
        return {}, labels
    order = sorted(outlines)
    if relief is not None:
        count = int(labels.max()) + 1
        known = (labels > 0) & relief.known
        total = np.bincount(labels[known], relief.depth_m[known], minlength=count)
        mean = total / np.maximum(np.bincount(labels[known], minlength=count), 1)
        order.sort(key=lambda number: -mean[number])
    return outlines, paint(outlines, labels, order=order)
