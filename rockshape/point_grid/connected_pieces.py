"""Connected pieces of images: pixels that neighbour one another without a step."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from rockshape.numerics.arrays import Floats

WAYS = ((0, 1), (1, 0), (1, 1), (1, -1))  # to half of the eight neighbours
MIN_LINKS = 2  # of a pixel to its neighbours: one may be by chance


def connected_pieces(*steps: tuple[Floats, Floats]) -> NDArray[np.intp]:
    """Number (rows, cols) of the piece of each pixel.

    steps are images (rows, cols), NaN where unknown, each with the step (rows, cols) that is
    allowed. Two of eight neighbours are joined where in every image they differ by no more than
    the step, or where one lies that near to the line through the other and the pixel behind it: a
    plane is one piece however steeply it is seen. A pixel with one such link is alone.
    """
    rows, cols = steps[0][0].shape
    joined = [np.logical_and.reduce([_joined(*step, way) for step in steps]) for way in WAYS]
    first = [np.flatnonzero(each) for each in joined]
    second = [each + row * cols + col for each, (row, col) in zip(first, WAYS, strict=True)]
    pairs = np.stack([np.concatenate(first), np.concatenate(second)])
    links = np.bincount(pairs.ravel(), minlength=rows * cols)
    pairs = pairs[:, (links[pairs] >= MIN_LINKS).all(axis=0)]
    graph = coo_array((np.ones(pairs.shape[1]), pairs), shape=(rows * cols, rows * cols))
    return np.asarray(connected_components(graph, directed=False)[1]).reshape(rows, cols)


def _joined(image: Floats, step: Floats, way: tuple[int, int]) -> NDArray[np.bool_]:
    """Whether each pixel (rows, cols) is joined in one image to its neighbour that way."""
    rows, cols = image.shape
    wide = np.pad(image, 2, constant_values=np.nan)
    behind, here, there, beyond = (
        wide[2 + k * way[0] :, 2 + k * way[1] :][:rows, :cols] for k in (-1, 0, 1, 2)
    )
    return np.asarray(
        (np.abs(there - here) <= step)
        | (np.abs(there - 2 * here + behind) <= step)
        | (np.abs(beyond - 2 * there + here) <= step)
    )
