"""What anyone would try first: a fixed height, Otsu's threshold, a plain watershed."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.ground import fit_plane
from rockshape.observation import Observation
from validation.arrays import Labels
from validation.peers.finders.otsu import otsu
from validation.peers.finders.regions import connected, parted

HEIGHT_M = 0.03


def fixed_height(observation: Observation) -> Labels:
    """Connected regions higher than 3 cm above the plane of 3-sigma rejection."""
    return connected(_high(observation))


def plain_watershed(observation: Observation) -> Labels:
    """The watershed of the distance within regions higher than 3 cm, from its local maxima."""
    return parted(_high(observation))


def _high(observation: Observation) -> NDArray[np.bool_]:
    points_m = observation.points_m
    plane = None if points_m is None else fit_plane(points_m)
    if plane is None or points_m is None:
        return np.zeros(observation.image.shape, dtype=bool)
    return np.asarray(np.nan_to_num(plane.height_m(points_m)) > HEIGHT_M)


@dataclass(frozen=True)
class Baseline:
    """Plain way to find rocks, by range or by the image alone."""

    segment: Callable[[Observation], Labels]
    by_range: bool


BASELINES: Mapping[str, Baseline] = {
    "height": Baseline(fixed_height, by_range=True),
    "otsu": Baseline(otsu, by_range=False),
    "watershed": Baseline(plain_watershed, by_range=True),
}
