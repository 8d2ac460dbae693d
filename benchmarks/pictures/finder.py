"""Sheet of the photographs with masks: what the image branch and what the network finds."""

from pathlib import Path

import cv2
import msgspec
import numpy as np
from PIL import Image, ImageDraw

from validation.execution.units import Unit
from validation.kinds.photographs.work import run
from validation.suite.suite import load_suite

SERIES = {"image": "image branch", "network": "network"}
SIDE_PX, GAP_PX, HEAD_PX = 300, 6, 22


def draw(out: Path) -> None:
    """Draw finder.jpg: each picture once below the other, by two finders, five a row."""
    pairs = []
    for experiment in load_suite("photos").experiments:
        chosen = msgspec.structs.replace(experiment, series=tuple(SERIES), pictured=12)
        for series, scene in chosen.units:
            shown = run(Unit(chosen, series, scene)).pictures
            pairs.append([_cell(picture.jpeg, SERIES[picture.place.series]) for picture in shown])
    columns = [np.concatenate(pair) for pair in pairs]
    half = -(-len(columns) // 2)
    blank = np.full_like(columns[0], 255)
    columns += [blank] * (2 * half - len(columns))
    rows = [np.concatenate(columns[start : start + half], axis=1) for start in (0, half)]
    Image.fromarray(np.concatenate(rows)).save(out / "finder.jpg", quality=84)


def _cell(jpeg: bytes, name: str) -> np.ndarray:
    """Return a picture in a square under its finder's name."""
    image = cv2.imdecode(np.frombuffer(jpeg, dtype=np.uint8), cv2.IMREAD_COLOR)[..., ::-1]
    scale = SIDE_PX / max(image.shape[:2])
    image = cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    cell = Image.new("RGB", (SIDE_PX + GAP_PX, SIDE_PX + GAP_PX + HEAD_PX), "white")
    cell.paste(Image.fromarray(image), (0, HEAD_PX))
    ImageDraw.Draw(cell).text((2, 4), name, fill="black", font_size=14)
    return np.asarray(cell)
