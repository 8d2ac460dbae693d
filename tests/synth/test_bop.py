"""Run lengths and diameters."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.distance import pdist

from synth.dataset.bop import diameter_m, run_lengths
from synth.rocks.ellipsoid import ellipsoid_mesh


@given(st.lists(st.lists(st.booleans(), min_size=3, max_size=3), min_size=1, max_size=6))
def test_run_lengths_rebuild_the_mask(rows):
    mask = np.array(rows)
    counts = run_lengths(mask)
    flat = np.repeat(np.arange(len(counts)) % 2 == 1, counts)
    np.testing.assert_array_equal(flat.reshape(mask.shape, order="F"), mask)


def test_run_lengths_start_with_zeros():
    assert run_lengths(np.array([[True, False]])) == [0, 1, 1]
    assert run_lengths(np.zeros((2, 2), dtype=bool)) == [4]


@pytest.mark.parametrize("half_axes_m", [(0.2, 0.15, 0.1), (0.1, 0.1, 0.1)])
def test_diameter_of_an_ellipsoid(half_axes_m):
    # The mesh has vertices at both ends of each axis: exact to rounding.
    mesh = ellipsoid_mesh(np.array(half_axes_m))
    assert diameter_m(mesh.vertices_m) == pytest.approx(2 * half_axes_m[0], rel=1e-9)


def test_diameter_is_the_farthest_pair():
    points_m = np.random.default_rng(0).standard_normal((60, 3))
    assert diameter_m(points_m) == pytest.approx(pdist(points_m).max(), rel=1e-12)
