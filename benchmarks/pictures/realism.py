"""Made pictures beside photographs of their kind."""

from itertools import zip_longest
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image
from real_pictures import PHOTOGRAPHS, bed_pictures, plain_pictures, site_pictures

Bytes = NDArray[np.uint8]

SIDE_PX, GAP_PX = 256, 6
FIRST = 10_000


def _cell(picture: Bytes) -> Bytes:
    """Return the middle of a picture, enlarged where it is smaller."""
    side = min(*picture.shape[:2], SIDE_PX)
    top, left = ((length - side) // 2 for length in picture.shape[:2])
    part = cv2.resize(picture[top : top + side, left : left + side], (SIDE_PX, SIDE_PX))
    edge = (0, GAP_PX, 0, GAP_PX)
    return np.asarray(cv2.copyMakeBorder(part, *edge, cv2.BORDER_CONSTANT, value=[255] * 3))


def draw(folder: Path) -> None:
    """Write realism.jpg: rows of gravel and Mars, each photographs above made pictures."""
    rows = [[photo.read() for photo in PHOTOGRAPHS["gravel"]]]
    rows.append(list(bed_pictures(range(FIRST, FIRST + 5))))
    rows.append([photo.read() for photo in PHOTOGRAPHS["Mars"]])
    rows.append(list(site_pictures(range(FIRST, FIRST + 5))))
    rows.append(list(plain_pictures(range(FIRST, FIRST + 5))))
    blank = np.full((SIDE_PX, SIDE_PX, 3), 255, np.uint8)
    columns = zip_longest(*rows, fillvalue=blank)
    sheet = np.hstack([np.vstack([_cell(one) for one in column]) for column in columns])
    Image.fromarray(sheet).save(folder / "realism.jpg", quality=85)
