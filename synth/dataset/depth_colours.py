"""Depth as a picture in colours, near yellow and far blue."""

import cv2
import numpy as np
from numpy.typing import NDArray

_ENDS_PERCENT = (1.0, 99.0)  # of the depths, the ends of the colours


def depth_colours(
    depth: NDArray[np.floating], known: NDArray[np.bool_], *, paper: int
) -> NDArray[np.uint8]:
    """Colours (rows, cols, 3) of depth (rows, cols), the grey level `paper` where it is unknown."""
    if not known.any():
        return np.full((*depth.shape, 3), paper, dtype=np.uint8)
    near, far = np.percentile(depth[known], _ENDS_PERCENT)
    share = np.clip((far - np.where(known, depth, far)) / max(far - near, 1e-6), 0.0, 1.0)
    colours = cv2.applyColorMap(np.rint(255.0 * share).astype(np.uint8), cv2.COLORMAP_PLASMA)
    return np.where(known[..., None], colours, np.uint8(paper)).astype(np.uint8)
