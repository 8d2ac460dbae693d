"""Time of the 2-D measures: one silhouette in a warm process, and a hundred from file to table."""

import importlib
import tempfile
import warnings
from collections.abc import Callable
from pathlib import Path
from sys import executable

import cv2
import numpy as np
from case import Case, Column, Table
from numpy.typing import NDArray
from silhouettes import REPORTED_FROM, draw
from skimage.measure import regionprops
from timing import NEVER, TIME_COLUMNS, Timing, best_of, timed_command

from rockshape.measures import angularity_2d, axis_ratio, ellipse_error, roundness, sphericity_2d
from rockshape.outline.descriptors import describe
from rockshape.rock.view import RockView

Mask = NDArray[np.bool_]

FLAT = (axis_ratio, ellipse_error, sphericity_2d, angularity_2d)
PAPER = tuple(module.PAPER for module in FLAT)
ROBUST = tuple(module.ROBUST for module in (*FLAT, roundness))
TEN = (
    "area",
    "perimeter",
    "axis_major_length",
    "axis_minor_length",
    "eccentricity",
    "orientation",
    "solidity",
    "extent",
    "feret_diameter_max",
    "equivalent_diameter_area",
)
# module, its function that takes a mask, and of what type
PEERS = {
    "fast_rs": ("fast_rs.rs", "rs_calculate", np.bool_),
    "partimorph": ("partimorph", "analyze_mask", np.uint8),
    "imea, 53 columns": ("imea", "shape_measurements_2d", np.bool_),
}
OPENCV = "cv2.findContours and cv2.fitEllipse"

READ = """
import csv, sys
import cv2
labels = cv2.imread(sys.argv[1], cv2.IMREAD_UNCHANGED)
"""
SCRIPTS = {
    "regionprops_table, ten properties": READ
    + f"""
from skimage.measure import regionprops_table
table = regionprops_table(labels, properties={TEN})
with open(sys.argv[2], "w", newline="") as file:
    csv.writer(file).writerows(zip(*table.values(), strict=True))
""",
    "the measures themselves, 19 columns": READ
    + """
import dataclasses
from rockshape.outline.descriptors import describe_edge
from rockshape.measures import angularity_2d, axis_ratio, ellipse_error, roundness, sphericity_2d
from rockshape.rock.instances import Instances
from rockshape.rock.view import RockView
modules = (axis_ratio, ellipse_error, sphericity_2d, angularity_2d, roundness)
measures = [m.PAPER for m in modules[:4]] + [m.ROBUST for m in modules]
with open(sys.argv[2], "w", newline="") as file:
    writer = csv.writer(file)
    for patch in Instances.from_labels(labels).largest_parts():
        rows, cols = patch.window
        rock = RockView(mask=patch.mask, corner=(rows.start, cols.start))
        values = [measure.read(rock).value for measure in measures]
        described = dataclasses.astuple(describe_edge(rock.edge_px))
        writer.writerow([patch.id, *values, *described])
""",
    "rockshape.measure, both methods": READ
    + """
import rockshape
paper = rockshape.measure(labels=labels, method="paper", descriptors=True).to_frame()
robust = rockshape.measure(labels=labels, method="robust").to_frame()
paper.merge(robust, on="rock").to_csv(sys.argv[2])
""",
    "reading the image alone": READ,
}


def one_silhouette(
    *, sizes_px: tuple[int, ...] = (200, 1000), rounds: int = 100, peers: bool = True
) -> list[Table]:
    """Time the measures, OpenCV and the peers that are installed on one mask of each size."""
    rows = []
    for size in sizes_px:
        mask = draw("roundness", seed=REPORTED_FROM, count=4)[2].mask(0.9 * size)
        mask = np.pad(mask, [(0, max(0, size - side)) for side in mask.shape])
        times = best_of(
            rounds,
            {
                OPENCV: lambda mask=mask: _opencv(mask),
                "the four 2-D measures of `paper`": lambda mask=mask: _read(mask, PAPER),
                "the five 2-D measures of `robust`": lambda mask=mask: _read(mask, ROBUST),
                "ten descriptors": lambda mask=mask: describe(mask),
            },
        )
        times |= best_of(2, {"skimage.measure.regionprops, ten": lambda mask=mask: _ten(mask)})
        for name, peer in _peers().items() if peers else ():
            times |= best_of(1, {name: lambda mask=mask, peer=peer: peer(mask)})
        rows += [(f"{size}²", name, *time.cells(times[OPENCV])) for name, time in times.items()]
    return [Table((Column("mask"), Column("work"), *TIME_COLUMNS), rows)]


def hundred_silhouettes(*, size_px: int = 200, rounds: int = 5) -> list[Table]:
    """Time whole processes that read a label image, measure its shapes and write a CSV."""
    best = dict.fromkeys(SCRIPTS, NEVER)
    with tempfile.TemporaryDirectory() as folder:
        image, out = str(Path(folder) / "labels.png"), str(Path(folder) / "out.csv")
        cv2.imwrite(image, _sheet(size_px))
        for _ in range(rounds):
            for name, script in SCRIPTS.items():
                time: Timing = timed_command([executable, "-c", script, image, out])
                best[name] = best[name].least(time)
    floor = best["regionprops_table, ten properties"]
    rows = [(name, *time.cells(floor)) for name, time in best.items()]
    return [Table((Column("process"), *TIME_COLUMNS), rows)]


def _peers() -> dict[str, Callable[[Mask], object]]:
    """Return the peers that are installed."""
    found = {}
    for name, (module, function, kind) in PEERS.items():
        try:
            found[name] = _quiet(getattr(importlib.import_module(module), function), kind)
        except ImportError:
            continue
    return found


def _quiet(function: Callable[[object], object], kind: type) -> Callable[[Mask], object]:
    """Return the function on masks of a type, without its warnings."""

    def call(mask: Mask) -> object:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return function(mask.astype(kind))

    return call


def _opencv(mask: Mask) -> object:
    pixels = mask.view(np.uint8)
    contours, _ = cv2.findContours(pixels, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    return cv2.fitEllipse(contours[0])


def _read(mask: Mask, measures: tuple) -> object:
    rock = RockView(mask=mask)
    return [measure.read(rock) for measure in measures]


def _ten(mask: Mask) -> object:
    region = regionprops(mask.view(np.uint8))[0]
    return [getattr(region, name) for name in TEN]


def _sheet(size: int) -> NDArray[np.uint16]:
    """Return a label image with a hundred silhouettes, ten a row."""
    shapes = [s for k in range(2) for s in draw("krumbein", seed=REPORTED_FROM + k)][:100]
    cell = int(1.5 * size)
    labels = np.zeros((10 * cell, 10 * cell), dtype=np.uint16)
    for index, shape in enumerate(shapes):
        mask = shape.mask(size)[:cell, :cell]
        row, col = (cell * place for place in divmod(index, 10))
        labels[row : row + mask.shape[0], col : col + mask.shape[1]][mask] = index + 1
    return labels


FLAT_SPEED_CASE = Case(
    name="flat_speed",
    what="2-D measures of one silhouette, from mask to numbers, in a warm process",
    run=one_silhouette,
    smallest={"sizes_px": (60,), "rounds": 2, "peers": False},
    peer=f"{OPENCV} on the same mask",
)

FLAT_BATCH_CASE = Case(
    name="flat_batch",
    what="100 silhouettes from a label image to a CSV, whole processes with their imports",
    run=hundred_silhouettes,
    smallest={"size_px": 30, "rounds": 1},
    peer="skimage's regionprops_table",
)
