"""Picture with outlines by what they are: found rightly, found wrongly, missed, or ignored."""

import cv2
import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.arrays import Labels
from validation.kinds.photographs.sources.masked_picture import MaskedPicture

MATCHED, EXTRA, MISSED, IGNORED = (80, 230, 90), (255, 70, 60), (70, 160, 255), (170, 170, 170)
TINT = 0.45


def draw(picture: MaskedPicture, found: Labels, objects: pd.DataFrame) -> NDArray[np.uint8]:
    """Picture (rows, cols, 3) with what was found and what was missed over it.

    Outlines of found rocks are green where they are matched, red where they are extra and grey
    where they are ignored; true ones are blue where they are missed. Where rocks are not told
    apart, pixels are tinted alike.
    """
    image = picture.image
    canvas = np.repeat(image[..., None], 3, axis=2) if image.ndim == 2 else image.copy()
    labels = picture.truth.labels
    if labels is None:
        return _tinted(canvas, picture.truth.rock, found > 0)
    status = objects["status"]
    missed = (objects.loc[status == "missed", "instance"] + 1).astype(int)
    _outline(canvas, np.where(np.isin(labels, missed), labels, 0), MISSED)
    right = objects.loc[status == "matched", "rock"].astype(int)
    wrong = objects.loc[status == "extra", "rock"].astype(int)
    _outline(canvas, np.where(np.isin(found, [*right, *wrong]), 0, found), IGNORED)
    _outline(canvas, np.where(np.isin(found, wrong), found, 0), EXTRA)
    _outline(canvas, np.where(np.isin(found, right), found, 0), MATCHED)
    return canvas


def _outline(canvas: NDArray[np.uint8], labels: Labels, colour: tuple[int, int, int]) -> None:
    """Paint the inner border of each label onto the canvas."""
    single, box = labels.astype(np.float32), np.ones((3, 3), dtype=np.uint8)
    border = (cv2.dilate(single, box) != single) | (cv2.erode(single, box) != single)
    canvas[border & (labels > 0)] = colour


def _tinted(
    canvas: NDArray[np.uint8], rock: NDArray[np.bool_], found: NDArray[np.bool_]
) -> NDArray[np.uint8]:
    for mask, colour in ((rock & found, MATCHED), (found & ~rock, EXTRA), (rock & ~found, MISSED)):
        tinted = (1 - TINT) * canvas[mask] + TINT * np.array(colour)
        canvas[mask] = tinted.astype(np.uint8)
    return canvas
