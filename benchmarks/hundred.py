"""A hundred silhouettes from a file to a table, whole processes: ours beside scikit-image's.

    python benchmarks/hundred.py [--size 200] [--rounds 5]

Each process starts, imports, reads the same label image, measures and writes a CSV: here every 2-D
column of both methods and the ten descriptors, nineteen in all; there regionprops_table with ten
properties. `rockshape.measure` is the same through the whole pipeline and a pandas table, once for
each method. Taken in turns; median seconds of wall time and of the processor, and their ratios to
regionprops_table's. A process that only reads the image and writes a CSV is the floor.
"""

import argparse
import resource
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
from rockshape.outline.descriptors import describe_smooth
from rockshape.measures import (
    angularity_2d, axis_ratio, ellipse_error, roundness, sphericity_2d)
from rockshape.rock.instances import Instances
from rockshape.rock.view import RockView
modules = (axis_ratio, ellipse_error, sphericity_2d, angularity_2d, roundness)
measures = [m.PAPER for m in modules[:4]] + [m.ROBUST for m in modules]
labels = cv2.imread(sys.argv[1], cv2.IMREAD_UNCHANGED)
with open(sys.argv[2], "w", newline="") as file:
    writer = csv.writer(file)
    for patch in Instances.from_labels(labels).largest_parts():
        rows, cols = patch.window
        rock = RockView(mask=patch.mask, corner=(rows.start, cols.start))
        values = [measure.read(rock).value for measure in measures]
        described = dataclasses.astuple(describe_smooth(rock.smooth_outline_px))
        writer.writerow([patch.id, *values, *described])
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
WHOLE = """
import sys
import cv2
import rockshape
labels = cv2.imread(sys.argv[1], cv2.IMREAD_UNCHANGED)
paper = rockshape.measure(labels=labels, method="paper", descriptors=True).to_frame()
robust = rockshape.measure(labels=labels, method="robust").to_frame()
paper.merge(robust, on="rock").to_csv(sys.argv[2])
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
        scripts = {
            "measures by themselves": OURS,
            "regionprops_table": THEIRS,
            "rockshape.measure": WHOLE,
            "floor": FLOOR,
        }
        taken: dict[str, list[tuple[float, float]]] = {name: [] for name in scripts}
        for turn in range(args.rounds + 1):
            for name, script in scripts.items():
                seconds = _seconds(script, str(image), str(Path(folder) / "out.csv"))
                if turn:  # the first warms the disk
                    taken[name].append(seconds)
    medians = {name: np.median(seconds, axis=0) for name, seconds in taken.items()}
    print(f"{'':24s}{'wall':>10s}{'processor':>12s}{'ratios':>14s}")
    for name, (wall, processor) in medians.items():
        ratios = (wall, processor) / medians["regionprops_table"]
        print(f"{name:24s}{wall:8.2f} s{processor:10.2f} s{ratios[0]:8.2f}{ratios[1]:6.2f}")


def _seconds(script: str, *arguments: str) -> tuple[float, float]:
    """Wall and processor time of one process from start to end."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run([sys.executable, "-c", script, *arguments], check=True)
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


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
