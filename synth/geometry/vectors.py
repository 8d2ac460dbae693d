"""Products of vectors; those of single ones are NumPy's to the bit, in a fraction of the time."""

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


def perpendicular(ways: Floats) -> tuple[Floats, Floats]:
    """Unit vectors (n, 3) at right angles to unit vectors (n, 3) and to each other."""
    first = np.cross(ways, np.eye(3)[np.argmin(np.abs(ways), axis=1)])
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return first, np.cross(ways, first)


def unit_rows(vectors: Floats) -> Floats:
    """Rows (n, d) divided by their lengths."""
    return np.asarray(vectors / np.sqrt(np.add.reduce(vectors * vectors, axis=1, keepdims=True)))
