"""What the paper's four 2-D measures cost beside OpenCV's contour and ellipse, in one process.

    python benchmarks/flat_speed.py [--rounds 200]

A silhouette of the size given, from mask to four numbers, beside cv2.findContours with
cv2.fitEllipse on the same mask, taken in turns, so that a busy machine slows both; warm medians and
their ratio to OpenCV's. Then the robust five, the descriptors, scikit-image's regionprops with ten
properties, and of fast_rs, imea and partimorph those that are installed (`pip install
rockshape[peers]`), once each after a first time; partimorph shrinks what is larger than its limit.
"""

import argparse
import importlib
import time
import warnings
from collections.abc import Callable

import cv2
import numpy as np
from numpy.typing import NDArray
from silhouettes import REPORTED_FROM, draw
from skimage.measure import regionprops

from rockshape.measures import (
    angularity_2d,
    axis_ratio,
    ellipse_error,
    roundness,
    sphericity_2d,
)
from rockshape.outline.descriptors import describe
from rockshape.rock.view import RockView

# module, its function that takes a mask, and of what type
PEERS = {
    "fast_rs": ("fast_rs.rs", "rs_calculate", np.bool_),
    "imea, 53 columns": ("imea", "shape_measurements_2d", np.bool_),
    "partimorph": ("partimorph", "analyze_mask", np.uint8),
}

PAPER = (axis_ratio.PAPER, ellipse_error.PAPER, sphericity_2d.PAPER, angularity_2d.PAPER)
ROBUST = (
    axis_ratio.ROBUST,
    ellipse_error.ROBUST,
    sphericity_2d.ROBUST,
    angularity_2d.ROBUST,
    roundness.ROBUST,
)
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


def main() -> None:
    """Print both sizes."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=200)
    args = parser.parse_args()
    for size in (200, 1000):
        mask = draw("roundness", seed=REPORTED_FROM, count=4)[2].mask(0.9 * size)
        mask = np.pad(mask, [(0, max(0, size - side)) for side in mask.shape])
        print(f"{mask.shape[0]} x {mask.shape[1]}")
        quick: dict[str, Callable[[], object]] = {
            "cv2.findContours + cv2.fitEllipse": lambda mask=mask: _opencv(mask),
            "the paper's four": lambda mask=mask: _read(mask, PAPER),
            "the robust five": lambda mask=mask: _read(mask, ROBUST),
            "descriptors": lambda mask=mask: describe(mask),
        }
        slow: dict[str, Callable[[], object]] = {"regionprops, ten": lambda mask=mask: _ten(mask)}
        medians = _medians_ms(quick, args.rounds) | _medians_ms(slow, 5)
        for name, peer in _peers().items():
            medians |= _medians_ms({name: lambda mask=mask, peer=peer: peer(mask)}, 1)
        floor = medians["cv2.findContours + cv2.fitEllipse"]
        for name, median in medians.items():
            print(f"  {name:34s} {median:9.3f} ms   {median / floor:8.2f}")


def _peers() -> dict[str, Callable[[NDArray[np.bool_]], object]]:
    found = {}
    for name, (module, function, kind) in PEERS.items():
        try:
            found[name] = _quietly(getattr(importlib.import_module(module), function), kind)
        except ImportError:
            continue
    return found


def _quietly(function: Callable[[object], object], kind: type) -> Callable[[object], object]:
    """The function of masks of a type, without its warnings."""

    def call(mask: NDArray[np.bool_]) -> object:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return function(mask.astype(kind))

    return call


def _opencv(mask: NDArray[np.bool_]) -> object:
    pixels = mask.view(np.uint8)
    contours, _ = cv2.findContours(pixels, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    return cv2.fitEllipse(contours[0])


def _read(mask: NDArray[np.bool_], measures: tuple) -> object:
    rock = RockView(mask=mask)
    return [measure.read(rock) for measure in measures]


def _ten(mask: NDArray[np.bool_]) -> object:
    region = regionprops(mask.view(np.uint8))[0]
    return [getattr(region, name) for name in TEN]


def _medians_ms(works: dict[str, Callable[[], object]], rounds: int) -> dict[str, float]:
    """Medians of works taken in turns, after one round to warm up."""
    times: dict[str, list[float]] = {name: [] for name in works}
    for _ in range(rounds + 1):
        for name, work in works.items():
            start = time.perf_counter()
            work()
            times[name].append(1000 * (time.perf_counter() - start))
    return {name: float(np.median(taken[1:])) for name, taken in times.items()}


if __name__ == "__main__":
    main()
