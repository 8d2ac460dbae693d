"""Rocks chosen among the regions of the network's answer and what they can be joined to."""

import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Floats
from rockshape.segmentation.by_network.answer import Answer
from rockshape.segmentation.by_network.likelihood import features_of, likelihood
from rockshape.segmentation.by_network.merge_tree import MergeTree, merge_tree
from rockshape.segmentation.by_network.regions import regions_of

LEAST = 0.35  # likelihood of a rock
MIN_PIXELS = 20


def cut_rocks(answer: Answer) -> NDArray[np.int32]:
    """Labels (rows, cols) from 1, 0 where no rock is.

    Of the ways to cut the merge tree into rocks and ground, the one is taken with the greatest sum
    of the rocks' likelihoods, each less the least that a rock has.
    """
    regions = regions_of(answer)
    tree = merge_tree(regions)
    if len(tree.children) == 0:
        return regions.labels
    gain = likelihood(features_of(tree)) - LEAST
    gain[tree.pixels.area < MIN_PIXELS] = 0.0
    rock = np.zeros(regions.count + 1, dtype=np.int32)
    rock[1:] = chosen(tree, gain)[: regions.count]
    return rock[regions.labels]


def chosen(tree: MergeTree, gain: Floats) -> NDArray[np.int32]:
    """Number (nodes,) from 1 of the rock that each node is part of, 0 of none."""
    best = np.maximum(gain, 0.0)
    whole = gain > 0.0
    for node, (one, two) in enumerate(tree.children.tolist()):
        if one >= 0:
            parts = best[one] + best[two]
            whole[node] = gain[node] > parts
            best[node] = max(gain[node], parts)
    number = np.zeros(len(gain), dtype=np.int32)
    count = 0
    for node in range(len(gain) - 1, -1, -1):
        if number[node] == 0 and whole[node]:
            count += 1
            number[node] = count
        one, two = tree.children[node]
        if one >= 0:
            number[one] = number[two] = number[node]
    return number
