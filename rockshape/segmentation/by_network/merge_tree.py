"""Merge tree: regions joined over their weakest seams, and what the joined ones are like."""

import heapq
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Floats
from rockshape.segmentation.by_network.regions import PixelSums, Regions

STRONGEST = 0.8  # mean probability of a border along a seam beyond which nothing is joined

Seams = dict[int, tuple[float, float]]  # by neighbour: length, and sum of border


@dataclass(frozen=True, eq=False)
class MergeTree:
    """Nodes 0 to n − 1 are regions 1 to n; each later one joins two earlier ones."""

    children: NDArray[np.intp]  # (nodes, 2), −1 of a region
    sums: Floats  # (nodes, 13), columns as PixelSums
    top: Floats  # (nodes,) greatest distance
    rim: Floats  # (nodes, 2): length of the outline, and sum of border along it
    seam: Floats  # (nodes, 2): the same of all seams within
    joint: Floats  # (nodes,) mean border of the seam that joined its parts, 0 of a region
    beyond: Floats  # (nodes,) that of the seam at which it is joined to another, 1 where to none

    @property
    def pixels(self) -> PixelSums:
        """Columns of `sums` by name."""
        return PixelSums(*self.sums.T)


def merge_tree(regions: Regions) -> MergeTree:
    """Tree of the regions of a picture.

    Of all seams the one with the least mean border is joined next. What is joined has the seams of
    its parts, summed.
    """
    count = regions.count
    most = max(2 * count - 1, 0)
    children = np.full((most, 2), -1, dtype=np.intp)
    sums, top = np.zeros((most, regions.sums.shape[1])), np.zeros(most)
    sums[:count], top[:count] = regions.sums[1:], regions.top[1:]
    rim, seam = np.zeros((most, 2)), np.zeros((most, 2))
    joint, beyond = np.zeros(most), np.ones(most)
    beside = _beside(regions, rim)
    waiting = [
        (border / length, one, two)
        for one, seams in enumerate(beside)
        for two, (length, border) in seams.items()
        if one < two
    ]
    heapq.heapify(waiting)
    alive = [True] * count
    while waiting:
        mean, one, two = heapq.heappop(waiting)
        if mean > STRONGEST:
            break
        if not (alive[one] and alive[two]):
            continue
        node = len(alive)
        length, border = beside[one][two]
        children[node] = one, two
        sums[node] = sums[one] + sums[two]
        top[node] = max(top[one], top[two])
        joint[node] = beyond[one] = beyond[two] = mean
        between = np.array([length, border])
        rim[node] = rim[one] + rim[two] - 2.0 * between
        seam[node] = seam[one] + seam[two] + between
        alive[one] = alive[two] = False
        alive.append(True)
        joined = _joined(beside, one, two, node)
        beside.append(joined)
        for other, (length, border) in joined.items():
            heapq.heappush(waiting, (border / length, other, node))
    nodes = len(alive)
    return MergeTree(
        children=children[:nodes],
        sums=sums[:nodes],
        top=top[:nodes],
        rim=rim[:nodes],
        seam=seam[:nodes],
        joint=joint[:nodes],
        beyond=beyond[:nodes],
    )


def _beside(regions: Regions, rim: Floats) -> list[Seams]:
    """Seams of each region with others; adds the length and border of its outline to rim."""
    beside: list[Seams] = [{} for _ in range(regions.count)]
    for one, two, length, border in zip(
        (regions.first - 1).tolist(),
        (regions.second - 1).tolist(),
        regions.length.tolist(),
        regions.border.tolist(),
        strict=True,
    ):
        rim[two] += length, border
        if one >= 0:
            rim[one] += length, border
            beside[one][two] = beside[two][one] = (length, border)
    return beside


def _joined(beside: list[Seams], one: int, two: int, node: int) -> Seams:
    """Seams of two nodes joined into another; those of their neighbours follow."""
    joined: Seams = {}
    for part in (one, two):
        for other, (length, border) in beside[part].items():
            if other in (one, two):
                continue
            before = joined.get(other, (0.0, 0.0))
            joined[other] = before[0] + length, before[1] + border
            del beside[other][part]
        beside[part] = {}
    for other, seams in joined.items():
        beside[other][node] = seams
    return joined
