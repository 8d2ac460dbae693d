"""A picture of discs with its mask, and a suite on it."""

import cv2
import numpy as np

from validation.execution.units import Unit, UnitResult
from validation.execution.work import run_unit
from validation.suite.suite import Suite

SUITE = """
name = "mine"
title = "Mine"

[[experiment]]
kind = "photographs"
name = "discs"
title = "Discs"
seed = 1
series = ["otsu", "top-hat"]
pictures = { from = "files", files = [{ image = "discs.png", mask = "mask.png" }] }

[[gate]]
score = "discs.otsu.f1"
at_least = 0.9
reason = "Dark discs on bright ground are what the threshold finds."
"""
# centre x, y and radius: two that count, one that the frame cuts, one that is too small
DISCS = ((60, 50, 20), (130, 60, 30), (0, 120, 25), (60, 130, 4))


def drawn() -> tuple[np.ndarray, np.ndarray]:
    """Picture of dark discs on bright ground, and their mask."""
    image, mask = np.full((160, 200), 200, np.uint8), np.zeros((160, 200), np.uint8)
    for number, (x, y, radius) in enumerate(DISCS, start=1):
        cv2.circle(image, (x, y), radius, 40, -1)
        cv2.circle(mask, (x, y), radius, 10 * number, -1)
    return image, mask


def results(suite: Suite) -> list[UnitResult]:
    """Results of all units of a suite's first experiment."""
    (experiment,) = suite.experiments
    return [run_unit(Unit(experiment, *unit)) for unit in experiment.units]
