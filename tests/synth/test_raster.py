"""Pixels that an outline encloses, against another's test of each pixel centre."""

import numpy as np
import pytest
from skimage.draw import polygon

from synth.shapes.raster import enclosed_pixels


@pytest.mark.parametrize("count", [3, 7, 60])
def test_enclosed_pixels_are_those_whose_centres_lie_inside(rng, count):
    # Also where the outline crosses itself and where it leaves the picture.
    for _ in range(20):
        outline_px = rng.uniform(-10.0, 50.0, (count, 2))
        expected = np.zeros((40, 45), dtype=bool)
        expected[polygon(outline_px[:, 1], outline_px[:, 0], shape=expected.shape)] = True
        np.testing.assert_array_equal(enclosed_pixels(outline_px, expected.shape), expected)


def test_a_tiling_covers_each_pixel_once_though_centres_lie_on_its_edges():
    square = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])
    covered = sum(
        enclosed_pixels(square + 4.0 * np.array([i, j]), (12, 12)).astype(int)
        for i in range(3)
        for j in range(3)
    )
    np.testing.assert_array_equal(covered, 1)
