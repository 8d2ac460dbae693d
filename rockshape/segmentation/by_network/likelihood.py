"""How likely a node of the merge tree is a whole rock."""

import json
from functools import cache

import numpy as np

from rockshape.numerics.arrays import Floats
from rockshape.segmentation.by_network.merge_tree import MergeTree
from rockshape.segmentation.by_network.weights import LIKELIHOOD, read_weights


def likelihood(features: Floats) -> Floats:
    """Likelihood (n,) from 0 to 1 of features (n, k): a logistic model of them and their squares.

    `python -m training.likelihood` fits it to made pictures.
    """
    level = terms(features) @ _coefficients(read_weights(LIKELIHOOD))
    return np.asarray(np.exp(-np.logaddexp(0.0, -level)))


def terms(features: Floats) -> Floats:
    """Terms (n, 2k + 1) of the model: one, the features and their squares."""
    return np.column_stack([np.ones(len(features)), features, features**2])


def features_of(tree: MergeTree) -> Floats:
    """What speaks for each node, (nodes, 9), each about 0 to 1 in size.

    Means of rock and of distance; mean border along the outline and along the seams within, and
    the length of these over the outline's; logarithms to base 2 of the width told over the one that
    the node has, and of the area, over 8; the area over that of the ellipse with the same moments;
    the outline's length over that of a disc's as digitised.
    """
    area, rock, distance, width, x, y, xx, xy, yy = tree.sums.T
    safe = np.maximum(area, 1.0)
    x, y = x / safe, y / safe
    own_xx = np.maximum(xx / safe - x * x, 0.0) + 1.0 / 12.0
    own_yy = np.maximum(yy / safe - y * y, 0.0) + 1.0 / 12.0
    own_xy = xy / safe - x * y
    middle, half = (own_xx + own_yy) / 2.0, np.hypot((own_xx - own_yy) / 2.0, own_xy)
    least, greatest = np.maximum(middle - half, 1.0 / 12.0), middle + half
    rim, seam = np.maximum(tree.rim[:, 0], 1.0), np.maximum(tree.seam[:, 0], 1.0)
    return np.column_stack(
        [
            rock / safe,
            distance / safe,
            tree.rim[:, 1] / rim,
            tree.seam[:, 1] / seam,
            tree.seam[:, 0] / rim,
            width / safe - np.log2(4.0 * np.sqrt(least)),
            np.log2(safe) / 8.0,
            area / (4.0 * np.pi * np.sqrt(least * greatest)),
            rim / (8.0 * np.sqrt(safe / np.pi)),
        ]
    )


@cache
def _coefficients(content: bytes) -> Floats:
    return np.array(json.loads(content)["coefficients"])
