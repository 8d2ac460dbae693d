"""Records of a designed experiment as arrays with an axis for each cause."""

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.arrays import Floats
from validation.kinds.design.spec import CLEAN, FOUND, NOISY, DesignExperiment

TRUTHS = ("truth_outline_axis_ratio", "truth_outline_roundness")


@dataclass(frozen=True, eq=False)
class Cubes:
    """One measure of all rocks, scene by scene; NaN where it could not be measured."""

    clean: Floats  # (rocks, views, distances, rolls)
    found: Floats  # (rocks, views, distances, suns, rolls)
    noisy: Floats  # (rocks, views, distances, suns, rolls)
    eligible: NDArray[np.bool_]  # (rocks, views, distances, rolls), seen whole
    outlines: Floats  # (rocks, views, 2), each view's true axis ratio and roundness
    rocks_a_scene: int


def cubes_of(
    records: pd.DataFrame, experiment: DesignExperiment, *, method: str, measure: str
) -> Cubes:
    """Values of one measure by one method; rocks not seen whole are NaN."""
    own = records[(records["experiment"] == experiment.name) & (records["method"] == method)]
    count = experiment.scene.rocks.count
    shape = (
        experiment.scenes * count,
        experiment.scene.views.count,
        len(experiment.distances_m),
        len(experiment.suns),
        len(experiment.rolls_deg),
    )
    state = own["series"].to_numpy()
    rock = own["scene"].to_numpy(np.int64) * count + own["instance"].to_numpy(np.int64)
    view, distance, sun, roll = (
        own[name].to_numpy(np.int64) for name in ("view", "distance", "sun", "roll")
    )
    usable = own["eligible"].to_numpy(bool) & (own["status"] == "matched").to_numpy()
    value = np.where(usable, own[measure].to_numpy(np.float64), np.nan)
    cubes = {}
    for name in (CLEAN, FOUND, NOISY):
        cube = np.full(shape, np.nan)
        at = state == name
        cube[rock[at], view[at], distance[at], sun[at], roll[at]] = value[at]
        cubes[name] = cube
    eligible = np.zeros((*shape[:3], shape[4]), dtype=bool)
    outlines = np.full((*shape[:2], len(TRUTHS)), np.nan)
    at = state == CLEAN
    eligible[rock[at], view[at], distance[at], roll[at]] = own["eligible"].to_numpy(bool)[at]
    outlines[rock[at], view[at]] = own[list(TRUTHS)].to_numpy(np.float64)[at]
    return Cubes(
        clean=cubes[CLEAN][:, :, :, 0],
        found=cubes[FOUND],
        noisy=cubes[NOISY],
        eligible=eligible,
        outlines=outlines,
        rocks_a_scene=count,
    )
