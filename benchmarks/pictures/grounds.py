"""Contact sheet of made grounds beside a picture of Mars."""

from pathlib import Path

import cv2
import numpy as np
from PIL import Image

from synth import make_scene

ROOT = Path(__file__).parents[2]
SIDE_PX, CROP_PX = 480, 960
PHOTO = ROOT / "examples" / "mars" / "i944014r.png"
FIELD = {"kind": "golombek-rapp", "radius_m": 3.0, "d_min_m": 0.12}
LOW = {"elevation_deg": 14.0, "target_m": [0.0, 0.0, 0.4], "distance_m": 6.0}
CRUST = {"terrain": {"crust": 0.8, "drift": 0.15, "crust_plate_m": 0.3}, "pebbles_per_m2": 60.0}
SCENES = (
    {"population": FIELD, "family": "realistic", "camera": {"elevation_deg": 30.0}, "seed": 11},
    {"population": FIELD, "family": "realistic", "camera": LOW, "seed": 12},
    {"family": "realistic", "seed": 1},
    {"site": "gale", "family": "realistic", "seed": 3},
    {"site": "dunes", "family": "realistic", "camera": LOW, "seed": 4},
    {"ground": CRUST, "family": "realistic", "seed": 5},
)


def cell(image: np.ndarray) -> np.ndarray:
    """Return the middle of an image in display values, with a white border."""
    rows, columns = image.shape[:2]
    top, left = max(rows - CROP_PX, 0) // 2, max(columns - CROP_PX, 0) // 2
    part = image[top : top + CROP_PX, left : left + CROP_PX]
    small = cv2.resize(part, (SIDE_PX, SIDE_PX), interpolation=cv2.INTER_AREA)
    return cv2.copyMakeBorder(small, 0, 4, 0, 4, cv2.BORDER_CONSTANT, value=255)


def main() -> None:
    """Draw docs/images/grounds.jpg: two rows of three, and a photograph of Mars."""
    cells = [cell(make_scene(spec, views=1).render(0).image) for spec in SCENES]
    photo = cell(np.asarray(Image.open(PHOTO).convert("L")))
    rows = [
        np.concatenate([*cells[:3], photo], axis=1),
        np.concatenate([*cells[3:], np.full_like(photo, 255)], axis=1),
    ]
    sheet = Image.fromarray(np.concatenate(rows))
    sheet.save(ROOT / "docs" / "images" / "grounds.jpg", quality=88)


if __name__ == "__main__":
    main()
