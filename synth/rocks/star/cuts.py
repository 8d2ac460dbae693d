"""Soft intersections of half-spaces, whose faces may undulate."""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats, Ints
from synth.rocks.polyhedron import tangent_cuts

_BEHIND = 1e-9  # of the nearness of a plane that a ray never meets


@dataclass(frozen=True, eq=False)
class Cuts:
    """Soft minimum of planes round the origin.

    Along a direction w the radius is (Σ_i (n_i·w/h_i(w))₊^p)^(-1/p): the gauge is a p-norm of
    linear functions, so the body is convex where its planes are flat, and an edge's radius is
    about 1/p.
    """

    normals: Floats  # (k, 3)
    distances: Floats  # (k,)
    steep: float  # p

    def radii(self, directions: Floats, swell: Floats | float = 1.0) -> Floats:
        """Radii (n,) along directions (n, 3), the planes' distances times a swell (n, k)."""
        nearness = np.maximum(directions @ (self.normals / self.distances[:, None]).T, _BEHIND)
        nearness /= swell
        nearest = nearness.max(axis=1, keepdims=True)
        total = ((nearness / nearest) ** self.steep).sum(axis=1)
        return np.asarray(total ** (-1.0 / self.steep) / nearest[:, 0])

    def points(self, directions: Floats) -> tuple[Floats, Ints]:
        """Points (n, 3) of the surface, all of one part."""
        radii = self.radii(directions)
        return radii[:, None] * directions, np.zeros(len(directions), dtype=np.int64)


def convex_core(*, cuts: int, softness: float, spread: float, rng: np.random.Generator) -> Cuts:
    """Smooth convex body of about radius 1: so many planes at distances of log-normal spread.

    `softness` is 1/p, about the edges' radius.
    """
    body = tangent_cuts(np.ones(3), cuts=cuts, rng=rng)
    distances = body.offsets_m() * np.exp(spread * rng.standard_normal(len(body.normals)))
    return Cuts(normals=body.normals.copy(), distances=distances, steep=1.0 / softness)
