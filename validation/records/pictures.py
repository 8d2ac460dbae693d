"""Pictures for the report: a view cut to what it shows, and what was found on it as lines.

Pictures are plain JPEGs. Outlines and ellipses are kept beside them as numbers, so that the page
can draw them sharp, show them or leave them out.
"""

from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.ellipse.direct import Ellipse
from validation.records.join import RecordKey

WIDEST_PX = 720
JPEG_QUALITY = 78
MIN_MARGIN_PX = 6
UNITS = 4  # of a mark's coordinates to a pixel of the picture
TRUE = "true"  # stands for the method in the mark of a true border
_TOLERANCE_PX = 0.6  # how far a mark's outline may leave the one it is made from


@dataclass(frozen=True)
class Mark:
    """What a method found of one rock, drawn on a picture; in quarters of the picture's pixels.

    Coordinates count from the picture's upper left corner, x to the right.
    """

    method: str  # or TRUE
    rock: int  # the method's number of the rock; the instance of a true border
    outline: tuple[int, ...]  # x, y, x, y, …
    ellipse: tuple[int, int, int, int, int] | None  # centre x, y, half-axes, degrees clockwise


@dataclass(frozen=True)
class Picture:
    """A JPEG of one view, and what was found on it."""

    place: RecordKey
    jpeg: bytes
    width_px: int
    height_px: int
    marks: tuple[Mark, ...] = ()

    @property
    def size_bytes(self) -> int:
        """The length of the JPEG."""
        return len(self.jpeg)


@dataclass(frozen=True)
class Portrait:
    """A small picture of one rock in one view: true, found or both."""

    picture: Picture
    instance: int | None  # the true rock; None for a thing found that is none
    rock: int | None  # that thing's number by the picture's method; None for a true rock


Album = Callable[[], tuple[Portrait, ...]]  # a unit's portraits, read when they are asked for


@dataclass(frozen=True)
class Cut:
    """A part of an image in pixels of the image, and the size it is shown at."""

    top: int
    bottom: int
    left: int
    right: int
    width_px: int
    height_px: int

    def units(self, x_px: NDArray[np.float64], y_px: NDArray[np.float64]) -> NDArray[np.float64]:
        """Places of the image, where a pixel's centre is whole, in a mark's units (n, 2)."""
        across = UNITS * self.width_px / (self.right - self.left)
        down = UNITS * self.height_px / (self.bottom - self.top)
        return np.column_stack([across * (x_px + 0.5 - self.left), down * (y_px + 0.5 - self.top)])


def cut_round(
    shown: NDArray[np.bool_], *, margin: float, widest_px: int, square: bool = False
) -> Cut:
    """Cut round all that is shown, (rows, cols), or the whole image without any.

    `margin` is a share of the longer side. The cut's longer side becomes `widest_px` or less. A
    square cut is one as far as the image reaches.
    """
    rows, cols = np.nonzero(shown.any(axis=1))[0], np.nonzero(shown.any(axis=0))[0]
    top, bottom, left, right = 0, shown.shape[0], 0, shown.shape[1]
    if rows.size:
        spans = int(rows[-1] - rows[0]) + 1, int(cols[-1] - cols[0]) + 1
        extra = max(MIN_MARGIN_PX, round(margin * max(spans)))
        down, across = (extra + ((max(spans) - span) // 2 if square else 0) for span in spans)
        top, bottom = max(0, int(rows[0]) - down), min(bottom, int(rows[-1]) + 1 + down)
        left, right = max(0, int(cols[0]) - across), min(right, int(cols[-1]) + 1 + across)
    shrink = min(1.0, widest_px / max(bottom - top, right - left))
    return Cut(
        top,
        bottom,
        left,
        right,
        width_px=max(1, round((right - left) * shrink)),
        height_px=max(1, round((bottom - top) * shrink)),
    )


def jpeg_of(image: NDArray[np.uint8], cut: Cut) -> bytes:
    """Cut of an image, (rows, cols) grey or (rows, cols, 3) RGB, as a JPEG."""
    part = image[cut.top : cut.bottom, cut.left : cut.right]
    part = np.ascontiguousarray(part[..., ::-1] if part.ndim == 3 else part)
    small = cv2.resize(part, (cut.width_px, cut.height_px), interpolation=cv2.INTER_AREA)
    done, encoded = cv2.imencode(".jpg", small, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
    if not done:
        raise RuntimeError("the JPEG encoder refused an 8-bit image")
    return encoded.tobytes()


def compress(image_rgb: NDArray[np.uint8], labels: NDArray[np.int32]) -> tuple[bytes, int, int]:
    """JPEG of an image cut to the labels (rows, cols), its width and its height."""
    cut = cut_round(labels > 0, margin=0.12, widest_px=WIDEST_PX)
    return jpeg_of(image_rgb, cut), cut.width_px, cut.height_px


def mark(
    method: str,
    rock: int,
    outline_px: NDArray[np.float64],
    ellipse: Ellipse | None,
    cut: Cut,
) -> Mark:
    """Mark of an outline (n, 2) as (x, y) and of an ellipse, in pixels of the image."""
    places = cut.units(outline_px[:, 0], outline_px[:, 1]).astype(np.float32)
    kept = cv2.approxPolyDP(places[:, None], _TOLERANCE_PX * UNITS, True)[:, 0]
    return Mark(
        method,
        rock,
        outline=tuple(int(value) for value in np.rint(kept).ravel()),
        ellipse=None if ellipse is None else _ellipse_units(ellipse, cut),
    )


def _ellipse_units(ellipse: Ellipse, cut: Cut) -> tuple[int, int, int, int, int] | None:
    ((x, y),) = cut.units(np.array([ellipse.x]), np.array([ellipse.y]))
    scale = UNITS * cut.width_px / (cut.right - cut.left)
    sizes = (x, y, scale * ellipse.major, scale * ellipse.minor)
    if max(abs(size) for size in sizes) > 1000 * UNITS * max(cut.width_px, cut.height_px):
        return None  # a runaway fit
    turn_deg = round(float(np.degrees(ellipse.angle_rad)))
    return round(sizes[0]), round(sizes[1]), round(sizes[2]), round(sizes[3]), turn_deg
