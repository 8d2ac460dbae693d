"""Even meshes of the unit sphere, and band-limited random functions on it."""

from collections.abc import Iterator
from functools import lru_cache

import numpy as np
import trimesh

from synth.arrays import Floats, Ints

_DIGITS = 14  # to which equal heights are told
SUBDIVISIONS = 5  # 20,480 faces: 0.04 mm from a surface of 0.2 m radius


@lru_cache(maxsize=4)
def unit_sphere(subdivisions: int = SUBDIVISIONS) -> tuple[Floats, Ints]:
    """Even mesh of the unit sphere: directions (n, 3) and faces (m, 3), read-only."""
    sphere = trimesh.creation.icosphere(subdivisions=subdivisions)
    directions, faces = np.array(sphere.vertices), np.array(sphere.faces, dtype=np.int64)
    directions.setflags(write=False)
    faces.setflags(write=False)
    return directions, faces


def band_limited(
    directions: Floats, *, degrees: tuple[int, int], rng: np.random.Generator
) -> Floats:
    """Random function on the sphere, (n,), of the given degrees alone.

    It is Σ w_lm Y_lm with independent normal weights and ∫ Y² = 4π. A weight's deviation
    1/(l(2l + 1)) gives degree l the mean square 1/(l²(2l + 1)): coarse relief outweighs fine.
    Directions at the same height z, as an even mesh has many, share their Legendre functions.
    """
    weights = np.zeros((degrees[1] + 1, degrees[1] + 1, 2))  # degree, order, cosine and sine
    for degree in range(degrees[0], degrees[1] + 1):
        drawn = rng.standard_normal((degree + 1, 2))
        weights[degree, : degree + 1] = drawn / (degree * (2.0 * degree + 1.0))
    heights, place = np.unique(directions[:, 2].round(_DIGITS), return_inverse=True)
    level = np.hypot(directions[:, 0], directions[:, 1])
    turn = (directions[:, 0] + 1j * directions[:, 1]) / np.where(level > 0.0, level, 1.0)
    turned = np.ones(len(directions), dtype=complex)  # e^(i order azimuth)
    total = np.zeros(len(directions))
    for order in range(degrees[1] + 1):
        first = max(degrees[0], order)
        column = np.stack(list(_legendre(heights, order, degrees[1]))[first - order :])
        cosine, sine = weights[first:, order].T @ column
        total += cosine[place] * turned.real + sine[place] * turned.imag
        turned *= turn
    return total


def _legendre(cosine: Floats, order: int, last_degree: int) -> Iterator[Floats]:
    """Associated Legendre functions with ∫ Y² = 4π.

    P̄_mm = √2 √(Π (2k + 1)/(2k)) sinᵐ θ, without √2 for m = 0; then
    P̄_lm = a (cos θ P̄_(l−1)m − P̄_(l−2)m/a') with a = √((4l² − 1)/(l² − m²)) and a' the a of
    l − 1 (Holmes and Featherstone 2002, eq. 11).
    """
    steps = np.arange(1, order + 1)
    scale = np.sqrt((2.0 if order else 1.0) * np.prod((2.0 * steps + 1.0) / (2.0 * steps)))
    before, now = np.zeros_like(cosine), scale * np.maximum(1.0 - cosine**2, 0.0) ** (order / 2.0)
    yield now
    scale_before = 1.0
    for degree in range(order + 1, last_degree + 1):
        scale = np.sqrt((4.0 * degree**2 - 1.0) / (degree**2 - order**2))
        before, now = now, scale * (cosine * now - before / scale_before)
        scale_before = scale
        yield now
