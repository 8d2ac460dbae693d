"""Pebbles: how many there are, and which are left out where they would be too many."""

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from synth.errors import SpecError
from synth.scene import pebbles as module
from synth.scene.pebbles import pebbles
from synth.spec.ground import GroundSpec

SPEC = GroundSpec(pebbles_per_m2=400.0, pebble_diameter_m=(0.01, 0.09))


def _level(points_m):
    return np.zeros(len(points_m))


def _places_and_widths(mesh):
    """Distance of each pebble from the middle, and its greatest width along an axis."""
    ends = mesh.faces[:, [0, 1, 1, 2]].reshape(-1, 2)
    count = len(mesh.vertices_m)
    links = coo_matrix((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(count, count))
    bodies, of = connected_components(links, directed=False)
    points = [mesh.vertices_m[of == body] for body in range(bodies)]
    away = np.array([np.linalg.norm(each[:, :2].mean(axis=0)) for each in points])
    return away, np.array([np.ptp(each, axis=0).max() for each in points])


def test_too_many_on_a_disc_are_refused():
    with pytest.raises(SpecError, match=r"at most 60000 pebbles on a disc of 9 m, found 101788"):
        pebbles(SPEC, _level, radius_m=9.0, rng=np.random.default_rng(1))


def test_of_too_many_on_rough_ground_the_smallest_are_left_out(monkeypatch):
    def made():
        rng = np.random.default_rng(1)
        return _places_and_widths(pebbles(SPEC, _level, radius_m=1.5, rng=rng, beyond=True))

    away, widths = made()
    assert len(away) > 6_000
    monkeypatch.setattr(module, "_MAX_PEBBLES", 2_000)
    fewer_away, fewer_widths = made()
    assert len(fewer_away) <= 2_000
    assert fewer_widths.min() > 1.2 * widths.min()
    # Those that are large enough lie on the disc as densely as before.
    all_large = ((away < 1.5) & (widths > 0.035)).sum()
    large = ((fewer_away < 1.5) & (fewer_widths > 0.035)).sum()
    assert all_large > 80
    assert large == pytest.approx(all_large, abs=4.0 * np.sqrt(2.0 * all_large))
