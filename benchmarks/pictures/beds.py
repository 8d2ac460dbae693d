"""Contact sheet of gravel beds beside photographs of the examples."""

from pathlib import Path

import cv2
import numpy as np
from PIL import Image

from synth import make_bed

ROOT = Path(__file__).parents[2]
SIDE_PX, ZOOM = 256, 1.25
PHOTO = ROOT / "examples" / "grains" / "1_P1060330_1.jpg"
COLOUR = {"grey": 0.0}
BEDS = (
    {"grains": {"median_px": [22, 22], "cover": [2.2, 2.2]}, "light": {"palettes": ["river"]}},
    {"grains": {"median_px": [34, 34], "cover": [2.5, 2.5]}, "light": {"palettes": ["limestone"]}},
    {
        "grains": {"median_px": [20, 20], "cover": [1.0, 1.0], "shapes": ["cobble", "lumpy"]},
        "ground": {"kinds": ["sand"], "filled": 1.0, "fill": [0.3, 0.3]},
        "light": {"palettes": ["river"]},
    },
    {
        "grains": {"median_px": [20, 20], "cover": [0.35, 0.35], "shapes": ["angular", "broken"]},
        "ground": {"kinds": ["rubble"]},
        "light": {"palettes": ["mars"], "overcast": 0.0, "elevation_deg": [25, 25]},
    },
    {
        "grains": {"median_px": [30, 30], "cover": [0.3, 0.3], "shapes": ["slab", "angular"]},
        "ground": {"kinds": ["crust"]},
        "light": {"palettes": ["basalt"], "overcast": 0.0},
    },
    {
        "grains": {"median_px": [16, 16], "cover": [0.5, 0.5]},
        "ground": {"kinds": ["ripples"]},
        "light": {"palettes": ["mars"], "overcast": 0.0, "elevation_deg": [18, 18]},
    },
    {"grains": {"median_px": [12, 12], "cover": [1.8, 1.8]}, "light": {"palettes": ["mixed"]}},
)


def cell(image: np.ndarray) -> np.ndarray:
    """Return an image enlarged, with a white border."""
    large = cv2.resize(image, None, fx=ZOOM, fy=ZOOM, interpolation=cv2.INTER_CUBIC)
    return cv2.copyMakeBorder(large, 0, 4, 0, 4, cv2.BORDER_CONSTANT, value=[255] * 3)


def draw(folder: Path) -> None:
    """Write beds.jpg: two rows of four, the last a photograph."""
    cells = []
    for index, spec in enumerate(BEDS):
        light = {**spec["light"], "azimuth_deg": [205, 245]}
        bed = make_bed({**spec, "light": light}, index=index, seed=1, photo=COLOUR)
        cells.append(cell(bed.image))
    cells.append(cell(np.asarray(Image.open(PHOTO).convert("RGB"))[:SIDE_PX, :SIDE_PX]))
    rows = [np.concatenate(cells[start : start + 4], axis=1) for start in (0, 4)]
    sheet = Image.fromarray(np.concatenate(rows))
    sheet.save(folder / "beds.jpg", quality=88)
