"""Tops of a map held to maps whose passes are known."""

import numpy as np

from rockshape.segmentation.by_network.tops import tops


def _two_bumps(pass_height: float) -> np.ndarray:
    """Tops of 0.9 at column 20 and of 0.6 at column 60 with a pass between them, on a row each."""
    cols = np.arange(81)
    heights = np.interp(cols, [0, 20, 40, 60, 80], [0, 0.9, pass_height, 0.6, 0])
    return np.repeat(heights[None].astype(np.float32), 5, axis=0)


def _columns(height: np.ndarray, rise: float) -> list[int]:
    mask = np.ones(height.shape, dtype=bool)
    return sorted(int(place % height.shape[1]) for place in tops(height, mask, rise=rise))


def test_the_lower_top_counts_where_it_rises_enough_above_the_pass():
    for pass_height, rise in ((0.32, 0.15), (0.42, 0.1), (0.02, 0.5)):
        first, second = _columns(_two_bumps(pass_height), rise)
        assert abs(first - 20) <= 2
        assert abs(second - 60) <= 3
    assert len(_columns(_two_bumps(0.52), 0.15)) == 1
    assert len(_columns(_two_bumps(0.32), 0.4)) == 1


def test_a_mask_parts_what_the_map_joins():
    height = _two_bumps(0.58)
    mask = np.ones(height.shape, dtype=bool)
    mask[:, 40] = False
    assert len(tops(height, mask, rise=0.3)) == 2
    assert len(tops(height, np.zeros_like(mask), rise=0.3)) == 0
