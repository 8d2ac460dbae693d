"""Pictures of a measurement: outlines, numbers and fitted ellipses over the image."""

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.measurement import Measurement, Rock

OUTLINE = (255, 209, 56)  # RGB: yellow and blue stay apart for every kind of colour vision
ELLIPSE = (64, 180, 255)
SMALLEST_SIDE_PX = 900  # a smaller image is enlarged by a whole factor, so that numbers can be read


def overlay(image: NDArray[np.float32], measurement: Measurement) -> NDArray[np.uint8]:
    """The image, (rows, cols) from 0 to 1, with each rock's outline, number and ellipse.

    The result is (s rows, s cols, 3) RGB with a whole scale s >= 1 that brings the longer side to
    900 pixels or just over.
    """
    scale = max(1, -(-SMALLEST_SIDE_PX // max(image.shape)))
    grey = np.clip(np.rint(image * 255), 0, 255).astype(np.uint8)
    size = (image.shape[1] * scale, image.shape[0] * scale)
    enlarged = cv2.resize(grey, size, interpolation=cv2.INTER_CUBIC)
    canvas = cv2.cvtColor(enlarged, cv2.COLOR_GRAY2RGB).astype(np.uint8, copy=False)
    thick = max(1, round(max(size) / 500))
    for rock in measurement.rocks:
        _draw_lines(canvas, rock, scale, thick)
    for rock in measurement.rocks:
        _draw_number(canvas, rock, scale, thick)
    return canvas


def _draw_lines(canvas: NDArray[np.uint8], rock: Rock, scale: int, thick: int) -> None:
    """Outline and ellipse; a pixel's centre x lies at scale (x + 1/2) - 1/2 of the canvas."""
    if rock.ellipse is not None:
        _draw_ring(canvas, rock.ellipse.ring(), ELLIPSE, scale, thick)
    _draw_ring(canvas, rock.outline_px, OUTLINE, scale, thick)


def _draw_ring(
    canvas: NDArray[np.uint8],
    ring: NDArray[np.float64],
    colour: tuple[int, int, int],
    scale: int,
    thick: int,
) -> None:
    places = scale * (ring + 0.5) - 0.5
    limit = 4 * max(canvas.shape)  # a runaway ellipse must not overflow the drawing's integers
    fixed = np.rint(np.clip(places, -limit, limit) * 16).astype(np.int32)
    cv2.polylines(canvas, [fixed], True, colour, thick, cv2.LINE_AA, shift=4)


def _draw_number(canvas: NDArray[np.uint8], rock: Rock, scale: int, thick: int) -> None:
    text, font, size = str(rock.number), cv2.FONT_HERSHEY_SIMPLEX, 0.55 * thick
    (width, height), _ = cv2.getTextSize(text, font, size, thick)
    x = round(scale * (rock.col + 0.5) - width / 2)
    y = round(scale * (rock.row + 0.5) + height / 2)
    cv2.putText(canvas, text, (x, y), font, size, (0, 0, 0), thick + 3, cv2.LINE_AA)
    cv2.putText(canvas, text, (x, y), font, size, (255, 255, 255), thick, cv2.LINE_AA)
