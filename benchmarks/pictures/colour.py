"""Contact sheet of scenes in colour: low sun, veins and layers, wet, things and their mask."""

from pathlib import Path

import cv2
import numpy as np

import synth

CELL_PX = 340
QUALITY = 82
COMMON = {
    "rocks": {"count": 4, "diameter_m": [0.3, 0.5]},
    "camera": {"preset": "mer-navcam", "distance_m": 3},
    "views": {"count": 1, "start_deg": 140},
    "renderer": "embree",
}
FILMIC = {"colour": True, "tone": "filmic", "exposure_stops": [-0.7, -0.7]}
WARM = {"sun": [1.0, 0.93, 0.8], "sky": [0.9, 0.75, 0.55]}
THINGS = {"kinds": ["ruler", "cable", "ball", "wheel", "deck", "mast-shadow"]}
LITHOLOGIES = ["basalt", "tan", "red", "pale"]
SCENES = (
    {"seed": 41, "light": {**WARM, "elevation_deg": [12, 12], "azimuth_deg": [60, 60]}},
    {"seed": 42, "tints": {"lithologies": LITHOLOGIES, "veins": 1.0, "layers": 0.5}},
    {"seed": 43, "tints": {"lithologies": LITHOLOGIES, "wetness": [1, 1]}},
    {"seed": 44, "light": {**WARM, "ambient": [0.9, 0.9]}, "surface": {"dust": 0.8}},
    {"seed": 31, "light": {**WARM, "elevation_deg": [35, 35]}, "things": THINGS},
)


def draw(folder: Path) -> None:
    """Write colour.jpg: five scenes, and the mask of the last one's things."""
    views = [synth.make_scene({**COMMON, "image": FILMIC, **one}).render(0) for one in SCENES]
    colours = np.array(
        [[0] * 3, [230] * 3, [0, 160, 230], [120] * 3, [230, 190, 0], [0] * 3, [220, 40, 20]]
    )
    cells = [view.image for view in views]
    cells.append(colours[views[-1].not_rock].astype(np.uint8))
    small = [cv2.resize(cell, (CELL_PX, CELL_PX), interpolation=cv2.INTER_AREA) for cell in cells]
    sheet = np.concatenate([np.concatenate(small[:3], axis=1), np.concatenate(small[3:], axis=1)])
    cv2.imwrite(str(folder / "colour.jpg"), sheet[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, QUALITY])
