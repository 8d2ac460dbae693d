"""Contact sheet of made grounds beside a picture of Mars, and a picture of drift tails."""

from pathlib import Path

import cv2
import numpy as np
from PIL import Image

from synth import make_scene

ROOT = Path(__file__).parents[2]
SIDE_PX = 384
PHOTO = ROOT / "examples" / "mars" / "i944014r.png"
FIELD = {"kind": "golombek-rapp", "radius_m": 2.5, "d_min_m": 0.16}
IMP = {"preset": "imp", "distance_m": 8.0, "elevation_deg": 20.0}
LOW = {"preset": "sojourner", "distance_m": 3.5, "elevation_deg": 14.0, "target_m": [0, 0, 0.5]}
TAILS = {
    "ground": {"terrain": {"tail_length": [1.0, 3.0], "wind_deg": 250.0}},
    "population": FIELD,
    "camera": LOW,
    "seed": 12,
}
CRUST = {"terrain": {"crust": 0.8, "drift": 0.15, "crust_plate_m": 0.3}, "pebbles_per_m2": 60.0}
SCENES = (
    {"population": FIELD, "camera": IMP, "seed": 11},
    {"population": FIELD, "camera": LOW, "seed": 12},
    {"camera": {"preset": "imp", "distance_m": 9.0}, "seed": 1},
    {"site": "gale", "camera": LOW, "seed": 3},
    {"site": "dunes", "camera": LOW, "seed": 4},
    {"ground": CRUST, "camera": {"preset": "imp", "distance_m": 8.0}, "seed": 5},
)


def cell(image: np.ndarray) -> np.ndarray:
    """Return the middle square of an image, with a white border."""
    rows, columns = image.shape[:2]
    side = min(rows, columns)
    top, left = (rows - side) // 2, (columns - side) // 2
    part = image[top : top + side, left : left + side]
    square = cv2.resize(part, (SIDE_PX, SIDE_PX), interpolation=cv2.INTER_CUBIC)
    return cv2.copyMakeBorder(square, 0, 4, 0, 4, cv2.BORDER_CONSTANT, value=[255] * 3)


def made(spec: dict[str, object]) -> np.ndarray:
    """Return the colour picture of a scene."""
    colour = {"colour": True}
    scene = make_scene(spec, image=colour, renderer="embree", views=1)
    return scene.render(0).image


def draw(folder: Path) -> None:
    """Write grounds.jpg, six made grounds and a photograph, and tails.jpg."""
    cells = [cell(made(spec)) for spec in SCENES]
    photo = cell(np.asarray(Image.open(PHOTO).convert("RGB")))
    rows = [
        np.concatenate([*cells[:3], photo], axis=1),
        np.concatenate([*cells[3:], np.full_like(photo, 255)], axis=1),
    ]
    sheet = Image.fromarray(np.concatenate(rows))
    sheet.save(folder / "grounds.jpg", quality=88)
    Image.fromarray(made(TAILS)).save(folder / "tails.jpg", quality=88)
