"""Products of single vectors, to the bit NumPy's, without the time its general functions take."""

import math

import numpy as np

from synth.arrays import Floats


def cross(first: Floats, second: Floats) -> Floats:
    """Cross product of two vectors (3,)."""
    (a, b, c), (x, y, z) = first.tolist(), second.tolist()
    return np.array([b * z - c * y, c * x - a * z, a * y - b * x])


def length(vector: Floats) -> float:
    """Euclidean length of a vector (n,)."""
    return math.sqrt(vector @ vector)


def unit_rows(vectors: Floats) -> Floats:
    """Rows (n, d) divided by their lengths."""
    return np.asarray(vectors / np.sqrt(np.add.reduce(vectors * vectors, axis=1, keepdims=True)))
