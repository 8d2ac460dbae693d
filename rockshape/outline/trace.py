"""The outline of a rock: the boundary pixels of its mask, in order."""

import cv2
import numpy as np
from numpy.typing import NDArray


def trace_outline(mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Boundary pixels of the mask's largest part, clockwise as seen in the image.

    mask is (rows, cols). The result is (n, 2) as (x, y) = (column, row) in pixels: the centres of
    the mask's 8-connected outer boundary pixels, which lie half a pixel inside the mask's edge.
    A neck one pixel wide is passed twice. (0, 2) for an empty mask.
    Source: Fox et al. (2002), section 2, "simple edge-finding techniques"; traced as by Suzuki and
    Abe (1985).
    """
    contours, _ = cv2.findContours(
        np.ascontiguousarray(mask, dtype=np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE
    )
    if not contours:
        return np.empty((0, 2))
    longest = max(contours, key=cv2.contourArea) if len(contours) > 1 else contours[0]
    outline = longest[:, 0, :].astype(np.float64)
    return outline if signed_area(outline) >= 0 else outline[::-1]


def signed_area(outline_px: NDArray[np.float64]) -> float:
    """Area within a closed polygon (n, 2); positive where it runs clockwise as seen (y down)."""
    if len(outline_px) == 0:
        return 0.0
    x, y = outline_px.T.copy()
    around = x[-1] * y[0] - y[-1] * x[0]
    return float(x[:-1] @ y[1:] - y[:-1] @ x[1:] + around) / 2
