"""Edge width of range held to ramps of known length."""

import numpy as np
import pytest

from rockshape.point_grid.edge_width import edge_width_px


def _range_of(ramp_px: int, noise: float = 0.0) -> np.ndarray:
    """Squares half a metre before a wall three metres away, their edges spread over ramp_px."""
    rows, cols = np.mgrid[:160, :160].astype(float)
    side = np.abs(((cols - 20) % 60) - 30) - 14.5
    before = np.clip(0.5 + side / ramp_px, 0.0, 1.0)
    inverse = 1.0 / 3.0 + before * (1.0 / 2.5 - 1.0 / 3.0) + 1e-4 * (rows / 160)
    inverse += noise * np.random.default_rng(1).normal(size=inverse.shape)
    depth = 1.0 / inverse
    return np.stack([cols * depth / 300, rows * depth / 300, depth], axis=-1)


@pytest.mark.parametrize("ramp_px", [1, 2, 4, 8])
def test_a_ramp_has_its_own_length(ramp_px):
    assert abs(edge_width_px(_range_of(ramp_px)) - ramp_px) <= 0.15 * ramp_px


@pytest.mark.parametrize("ramp_px", [1, 4])
def test_noise_of_a_hundredth_of_the_jump_moves_it_little(ramp_px):
    assert abs(edge_width_px(_range_of(ramp_px, noise=6.7e-4)) - ramp_px) <= 0.25 * ramp_px


def test_holes_are_left_out_and_a_grid_without_edges_has_none():
    points = _range_of(4)
    points[40:60, 40:60] = np.nan
    assert abs(edge_width_px(points) - 4.0) <= 0.6
    flat = np.ones((50, 50, 3))
    assert np.isnan(edge_width_px(flat))
    assert np.isnan(edge_width_px(np.full((50, 50, 3), np.nan)))
    assert np.isnan(edge_width_px(np.ones((5, 5, 3))))
