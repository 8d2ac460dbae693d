"""Likelihood of a node being a rock, fitted to made pictures."""

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from rockshape.segmentation.by_network.likelihood import Model, features_of, terms
from rockshape.segmentation.by_network.merge_tree import MergeTree, merge_tree
from rockshape.segmentation.by_network.regions import regions_of
from rockshape.segmentation.by_network.scales import joint_answer
from rockshape.segmentation.by_network.weights import LIKELIHOOD, weights_from
from training.augment import draw_crop
from training.mixture import PARTS, Shard
from training.shards import make_shards, read_tiles
from training.tile import SIDE_PX, Tile

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
FITTED = 900  # seed of the tiles that it is fitted to
_NO_ROCK, _ROCK = 0.3, 0.7  # intersection over union with the best rock
_DRAWS = 2  # other cameras for each
_RIDGE = 1e-2
_TAIL = 0.005  # share of each feature beyond either end


def fit(tiles: Iterator[Tile]) -> Model:
    """Logistic model, with a slight ridge, and the ends of its features.

    Tiles are seen as by other cameras, so that the answers are as unsure as those of pictures that
    the network has not been taught with.
    """
    rng = np.random.default_rng([FITTED, 80])
    rows, wanted = [], []
    for tile in tiles:
        for _ in range(_DRAWS):
            nodes, whole = samples(*draw_crop(tile, SIDE_PX, rng))
            rows.append(nodes)
            wanted.append(whole)
    features, target = np.concatenate(rows), np.concatenate(wanted)
    least, greatest = np.quantile(features, [_TAIL, 1.0 - _TAIL], axis=0)
    design = terms(np.clip(features, least, greatest))

    def cost(solution: Floats) -> tuple[float, Floats]:
        level = design @ solution
        share = np.exp(-np.logaddexp(0.0, -level))
        loss = np.logaddexp(0.0, level) - target * level
        slope = design.T @ (share - target) + _RIDGE * solution
        return float(loss.sum() + _RIDGE / 2.0 * solution @ solution), slope

    solution = minimize(cost, np.zeros(design.shape[1]), jac=True, method="BFGS").x
    return Model(np.asarray(solution), least, greatest)


def samples(picture: Singles, labels: NDArray[np.uint16]) -> tuple[Floats, Floats]:
    """Features (nodes, k) of a picture's merge tree, and what each node is: 0 none, 1 a rock."""
    regions = regions_of(joint_answer(picture))
    tree = merge_tree(regions)
    truth = labels.astype(np.intp)
    numbers = int(truth.max()) + 1
    common = np.bincount(
        regions.labels.ravel() * numbers + truth.ravel(), minlength=(regions.count + 1) * numbers
    ).reshape(-1, numbers)[:, 1:]
    shared = _summed(tree, common[1:].astype(np.float64))
    whole = np.bincount(truth.ravel(), minlength=numbers)[1:]
    if numbers == 1:
        return features_of(tree), np.zeros(len(tree.sums))
    union = tree.pixels.area[:, None] + whole - shared
    overlap = (shared / np.maximum(union, 1.0)).max(axis=1)
    return features_of(tree), np.clip((overlap - _NO_ROCK) / (_ROCK - _NO_ROCK), 0.0, 1.0)


def _summed(tree: MergeTree, leaves: Floats) -> Floats:
    summed = np.zeros((len(tree.children), leaves.shape[1]))
    summed[: len(leaves)] = leaves
    for node, (one, two) in enumerate(tree.children.tolist()):
        if one >= 0:
            summed[node] = summed[one] + summed[two]
    return summed


def fit_likelihood(folder: Path, *, tiles: int, jobs: int) -> None:
    """Fit the likelihood of the network in a folder to so many tiles of each part."""
    wanted = [Shard(part.name, FITTED, tiles) for part in PARTS]
    paths = make_shards(folder / "tiles", wanted, jobs=jobs)
    with weights_from(folder):
        model = fit(read_tiles(paths))
    numbers = {name: np.round(values, 4).tolist() for name, values in vars(model).items()}
    text = json.dumps(numbers, indent=1)
    (folder / LIKELIHOOD).write_text(text + "\n")
