"""Contact sheet of oblique gravel beds beside photographs of Mars."""

from pathlib import Path

import numpy as np
from pictures.beds import COLOUR, ROOT, SIDE_PX, cell
from PIL import Image

from synth import make_bed

PHOTOS = ("msl_332_part.jpg", "msl_538_part.jpg")
SUN = {"azimuth_deg": [205, 245], "overcast": 0.0}
BEDS = (
    (
        25,
        {"grains": {"median_px": [22, 22], "cover": [2.2, 2.2]}, "light": {"palettes": ["river"]}},
    ),
    (
        45,
        {"grains": {"median_px": [26, 26], "cover": [2.2, 2.2]}, "light": {"palettes": ["mixed"]}},
    ),
    (
        65,
        {"grains": {"median_px": [26, 26], "cover": [1.6, 1.6]}, "light": {"palettes": ["river"]}},
    ),
    (
        60,
        {
            "grains": {"median_px": [20, 20], "cover": [0.4, 0.4], "shapes": ["angular", "slab"]},
            "ground": {"kinds": ["rubble"]},
            "light": {"palettes": ["mars"]},
        },
    ),
)


def draw(folder: Path) -> None:
    """Write beds_oblique.jpg: tiles above, labels and photographs below."""
    tiles, labels = [], []
    hues = np.random.default_rng(0).integers(60, 256, (65536, 3)).astype(np.uint8)
    hues[0] = 0
    for index, (tilt, spec) in enumerate(BEDS):
        light = {**spec["light"], **SUN}
        bed = make_bed(
            {**spec, "light": light}, index=index, seed=1, tilt_deg=[tilt, tilt], photo=COLOUR
        )
        tiles.append(cell(bed.image))
        labels.append(hues[bed.labels])
    photos = [
        cell(np.asarray(Image.open(ROOT / "examples" / "photos" / name))[:SIDE_PX, :SIDE_PX])
        for name in PHOTOS
    ]
    below = [cell(labels[1]), cell(labels[3]), *photos]
    rows = [np.concatenate(row, axis=1) for row in (tiles, below)]
    sheet = np.concatenate(rows)
    Image.fromarray(sheet).save(folder / "beds_oblique.jpg", quality=85)
