"""What the network is asked for, held to closed forms on drawn labels."""

import numpy as np

from rockshape.segmentation.by_network.answer import width_of
from training.targets import targets_of


def _discs() -> np.ndarray:
    rows, cols = np.mgrid[:96, :128]
    labels = np.zeros((96, 128), dtype=np.uint16)
    labels[(rows - 40) ** 2 + (cols - 40) ** 2 <= 24**2] = 1
    labels[(rows - 40) ** 2 + (cols - 76) ** 2 <= 12**2] = 2
    labels[80:82, 100:102] = 3
    return labels


def test_distance_falls_from_one_in_the_middle_to_nothing_at_the_border_of_each_rock():
    targets = targets_of(_discs())
    assert targets.distance[40, 40] == targets.distance[40, 76] == 1.0
    for col, radius in ((40, 24.0), (76, 12.0)):
        halfway = targets.distance[40 - round(radius / 2), col]
        assert abs(halfway - 0.5) < 1.0 / radius
    assert targets.distance[0, 0] == 0.0


def test_width_is_the_diameter_of_a_disc():
    width_px = width_of(targets_of(_discs()).width)
    assert abs(width_px[40, 40] - 49.0) < 0.1 * 49.0
    assert abs(width_px[40, 76] - 25.0) < 0.1 * 25.0


def test_border_lies_between_two_rocks_that_touch_and_not_inside_either():
    targets = targets_of(_discs())
    assert targets.border[40, 63:66].all()
    assert not targets.border[40, 30:50].any()
    assert not targets.border[0, :].any()  # the frame's edge is none


def test_rocks_of_two_pixels_count_neither_as_rock_nor_as_ground():
    targets = targets_of(_discs())
    assert not targets.counts[80:82, 100:102].any()
    assert targets.counts[:70].all()


def test_bare_ground_has_targets():
    targets = targets_of(np.zeros((32, 32), dtype=np.uint16))
    assert not targets.rock.any()
    assert targets.counts.all()
    assert np.isfinite(targets.width).all()
