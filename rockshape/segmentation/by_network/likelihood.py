"""How likely a node of the merge tree is a whole rock."""

import json
from dataclasses import dataclass
from functools import cache

import numpy as np

from rockshape.numerics.arrays import Floats
from rockshape.segmentation.by_network.merge_tree import MergeTree
from rockshape.segmentation.by_network.regions import PixelSums
from rockshape.segmentation.by_network.weights import LIKELIHOOD, read_weights


def likelihood(features: Floats) -> Floats:
    """Likelihood (n,) from 0 to 1 of features (n, k): a logistic model of them and their products.

    `python -m training` fits it to made pictures. A feature beyond the ends that it had there
    counts as one at the end.
    """
    model = _model(read_weights(LIKELIHOOD))
    level = terms(np.clip(features, model.least, model.greatest)) @ model.coefficients
    return np.asarray(np.exp(-np.logaddexp(0.0, -level)))


def terms(features: Floats) -> Floats:
    """Terms (n, (k + 1)(k + 2)/2) of the model: products of each two of one and the features."""
    factors = np.column_stack([np.ones(len(features)), features])
    one, two = np.triu_indices(factors.shape[1])
    return np.asarray(factors[:, one] * factors[:, two])


def features_of(tree: MergeTree) -> Floats:
    """What speaks for each node, (nodes, 16), each about 0 to 1 in size.

    - Means of rock, of distance and of border within, and the greatest distance.
    - Standard deviations of rock and of the logarithm to base 2 of the width told.
    - That logarithm less that of the width that the node has.
    - Mean border along the outline, along the seams within, at the last of these that was joined
      and at the next that would be.
    - Length of the seams within and of the frame's edge, over the outline's.
    - Logarithm to base 2 of the area, over 8; the area over that of the ellipse with the same
      moments; the outline's length over that of a disc's as digitised.
    """
    area, frame = tree.pixels.area, tree.pixels.frame
    safe = np.maximum(area, 1.0)
    mean = PixelSums(*(total / safe for total in tree.pixels))
    own_xx = np.maximum(mean.xx - mean.x * mean.x, 0.0) + 1.0 / 12.0
    own_yy = np.maximum(mean.yy - mean.y * mean.y, 0.0) + 1.0 / 12.0
    own_xy = mean.xy - mean.x * mean.y
    middle, half = (own_xx + own_yy) / 2.0, np.hypot((own_xx - own_yy) / 2.0, own_xy)
    least, greatest = np.maximum(middle - half, 1.0 / 12.0), middle + half
    rim, seam = np.maximum(tree.rim[:, 0], 1.0), np.maximum(tree.seam[:, 0], 1.0)
    return np.column_stack(
        [
            mean.rock,
            mean.distance,
            mean.border,
            tree.top,
            np.sqrt(np.maximum(mean.rock_squared - mean.rock * mean.rock, 0.0)),
            np.sqrt(np.maximum(mean.width_squared - mean.width * mean.width, 0.0)),
            mean.width - np.log2(4.0 * np.sqrt(least)),
            tree.rim[:, 1] / rim,
            tree.seam[:, 1] / seam,
            tree.joint,
            tree.beyond,
            tree.seam[:, 0] / rim,
            frame / rim,
            np.log2(safe) / 8.0,
            area / (4.0 * np.pi * np.sqrt(least * greatest)),
            rim / (8.0 * np.sqrt(safe / np.pi)),
        ]
    )


@dataclass(frozen=True, eq=False)
class Model:
    """Logistic model of features and their products, within the ends of the fit."""

    coefficients: Floats  # ((k + 1)(k + 2)/2,)
    least: Floats  # (k,)
    greatest: Floats  # (k,)


@cache
def _model(content: bytes) -> Model:
    return Model(**{name: np.array(values) for name, values in json.loads(content).items()})
