"""Pictures for the report: an overlay cut to what it shows, scaled and compressed."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from validation.records import Place

WIDEST_PX = 720
JPEG_QUALITY = 82


@dataclass(frozen=True)
class Picture:
    """A JPEG of one view with what was measured drawn on it."""

    place: Place
    jpeg: bytes
    width_px: int
    height_px: int

    @property
    def size_bytes(self) -> int:
        """The length of the JPEG."""
        return len(self.jpeg)


def crop_box(labels: NDArray[np.int32], *, margin: float = 0.12) -> tuple[int, int, int, int]:
    """Return (top, bottom, left, right) in pixels round all labels, with a margin.

    `margin` is a share of the longer side. The whole image when there is no label.
    """
    rows, cols = np.nonzero(labels)
    if rows.size == 0:
        return 0, labels.shape[0], 0, labels.shape[1]
    top, bottom = int(rows.min()), int(rows.max()) + 1
    left, right = int(cols.min()), int(cols.max()) + 1
    extra = max(8, round(margin * max(bottom - top, right - left)))
    return (
        max(0, top - extra),
        min(labels.shape[0], bottom + extra),
        max(0, left - extra),
        min(labels.shape[1], right + extra),
    )


def compress(overlay_rgb: NDArray[np.uint8], labels: NDArray[np.int32]) -> tuple[bytes, int, int]:
    """Return a JPEG of the overlay cut to the labels, its width and its height in pixels.

    `overlay_rgb` is (rows·s, cols·s, 3) for labels (rows, cols).
    """
    scale = overlay_rgb.shape[0] / labels.shape[0]
    top, bottom, left, right = (round(scale * edge) for edge in crop_box(labels))
    cut = np.ascontiguousarray(overlay_rgb[top:bottom, left:right, ::-1])
    shrink = min(1.0, WIDEST_PX / cut.shape[1])
    width, height = round(cut.shape[1] * shrink), round(cut.shape[0] * shrink)
    small = cv2.resize(cut, (width, height), interpolation=cv2.INTER_AREA)
    done, encoded = cv2.imencode(".jpg", small, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
    if not done:
        raise RuntimeError("the JPEG encoder refused an 8-bit colour image")
    return encoded.tobytes(), width, height
