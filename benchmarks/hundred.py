"""A hundred silhouettes from a file to a table, whole processes: ours beside scikit-image's.

    python benchmarks/hundred.py [--size 200] [--rounds 5]

Each process starts, imports, reads the same label image, measures and writes a CSV: here every 2-D
column of both methods and the ten descriptors, nineteen in all; there regionprops_table with ten
properties. Taken in turns; median seconds and the ratio. A process that only reads the image and
writes a CSV is the floor.
"""

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import cv2
import numpy as np
from silhouettes import REPORTED_FROM, draw

OURS = """
import csv, dataclasses, sys
import cv2
import scipy.ndimage as ndi
from rockshape.descriptors import describe_smooth
from rockshape.measures import (
    angularity_2d, axis_ratio, ellipse_error, roundness, sphericity_2d)
from rockshape.rock_view import RockView
modules = (axis_ratio, ellipse_error, sphericity_2d, angularity_2d, roundness)
measures = [m.PAPER for m in modules[:4]] + [m.ROBUST for m in modules]
labels = cv2.imread(sys.argv[1], cv2.IMREAD_UNCHANGED)
with open(sys.argv[2], "w", newline="") as file:
    writer = csv.writer(file)
    for number, window in enumerate(ndi.find_objects(labels.astype("int32")), 1):
        rock = RockView(mask=labels[window] == number, corner=(window[0].start, window[1].start))
        values = [measure.read(rock).value for measure in measures]
        described = dataclasses.astuple(describe_smooth(rock.smooth_outline_px))
        writer.writerow([number, *values, *described])
"""
THEIRS = """
import csv, sys
import cv2
from skimage.measure import regionprops_table
labels = cv2.imread(sys.argv[1], cv2.IMREAD_UNCHANGED)
table = regionprops_table(labels, properties=(
    "area", "perimeter", "axis_major_length", "axis_minor_length", "eccentricity", "orientation",
    "solidity", "extent", "feret_diameter_max", "equivalent_diameter_area"))
with open(sys.argv[2], "w", newline="") as file:
    csv.writer(file).writerows(zip(*table.values(), strict=True))
"""
FLOOR = """
import csv, sys
import cv2
labels = cv2.imread(sys.argv[1], cv2.IMREAD_UNCHANGED)
with open(sys.argv[2], "w", newline="") as file:
    csv.writer(file).writerow([labels.max()])
"""


def main() -> None:
    """Print the seconds and the ratio."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--size", type=int, default=200)
    parser.add_argument("--rounds", type=int, default=5)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        image = Path(folder) / "labels.png"
        cv2.imwrite(str(image), _sheet(args.size))
        scripts = {"rockshape": OURS, "regionprops_table": THEIRS, "floor": FLOOR}
        seconds: dict[str, list[float]] = {name: [] for name in scripts}
        for turn in range(args.rounds + 1):
            for name, script in scripts.items():
                start = time.perf_counter()
                subprocess.run(
                    [sys.executable, "-c", script, str(image), str(Path(folder) / "out.csv")],
                    check=True,
                )
                if turn:  # the first warms the disk
                    seconds[name].append(time.perf_counter() - start)
    medians = {name: float(np.median(taken)) for name, taken in seconds.items()}
    for name, median in medians.items():
        print(f"{name:18s} {median:.2f} s")
    print(f"ratio {medians['rockshape'] / medians['regionprops_table']:.2f}")


def _sheet(size: int) -> np.ndarray:
    """A label image with a hundred silhouettes, ten a row."""
    shapes = [s for k in range(2) for s in draw("krumbein", seed=REPORTED_FROM + k)][:100]
    cell = int(1.5 * size)
    labels = np.zeros((10 * cell, 10 * cell), dtype=np.uint16)
    for index, shape in enumerate(shapes):
        mask = shape.mask(size)[:cell, :cell]
        row, col = (cell * place for place in divmod(index, 10))
        labels[row : row + mask.shape[0], col : col + mask.shape[1]][mask] = index + 1
    return labels


if __name__ == "__main__":
    main()
