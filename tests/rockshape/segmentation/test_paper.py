import numpy as np
import pytest

from rockshape.segmentation.published import RegionKind, classify, segment_heights


def dome(shape: tuple[int, int], row: float, col: float, radius: float, top: float) -> np.ndarray:
    """Heights of a half ellipsoid on the ground, 0 elsewhere."""
    y, x = np.mgrid[: shape[0], : shape[1]]
    inside = 1 - ((y - row) / radius) ** 2 - ((x - col) / radius) ** 2
    return top * np.sqrt(np.maximum(inside, 0))


def test_regions_are_told_by_their_neighbours() -> None:
    levels = np.array([[0, 0, 0, 0, 0, 0], [0, 1, 1, 2, 1, 0], [0, 0, 0, 0, 0, -1]])
    kinds = classify(levels, np.ones(levels.shape, dtype=bool))
    assert kinds[1].tolist() == [
        RegionKind.SIDE,  # the ground falls to the lower corner
        RegionKind.SIDE,
        RegionKind.SIDE,
        RegionKind.TOP,
        RegionKind.SIDE,
        RegionKind.SIDE,
    ]
    assert kinds[2, 5] == RegionKind.BOTTOM


def test_what_is_not_known_is_no_neighbour() -> None:
    levels = np.array([[5, 1, 5]])
    known = np.array([[True, True, False]])
    assert classify(levels, known).tolist() == [
        [RegionKind.TOP, RegionKind.BOTTOM, RegionKind.NONE]
    ]


def test_two_domes_on_the_ground_are_two_rocks() -> None:
    heights = dome((80, 120), 40, 30, 20, 0.2) + dome((80, 120), 40, 85, 25, 0.3)
    labels = segment_heights(heights, sigma_m=0.001)
    assert np.unique(labels).tolist() == [0, 1, 2]
    for number, col in ((2, 30), (1, 85)):
        assert labels[40, col] == number
    # a rock begins 5 mm above the ground, where these domes rise within a quarter pixel
    assert np.mean((labels > 0) == (heights > 0)) > 0.999


def test_touching_domes_part_in_the_valley() -> None:
    heights = np.maximum(dome((80, 120), 40, 40, 25, 0.3), dome((80, 120), 40, 80, 25, 0.3))
    labels = segment_heights(heights, sigma_m=0.001)
    assert labels.max() == 2
    assert set(np.unique(labels[:, :57])) == {0, 1}
    assert set(np.unique(labels[:, 64:])) == {0, 2}


def test_a_dent_belongs_to_its_rock() -> None:
    heights = dome((80, 80), 40, 40, 30, 0.3) - 3 * dome((80, 80), 40, 40, 6, 0.03)
    labels = segment_heights(heights, sigma_m=0.001)
    assert labels.max() == 1
    assert labels[40, 40] == 1


def test_bumps_below_two_levels_are_no_tops(rng: np.random.Generator) -> None:
    heights = dome((80, 80), 40, 40, 30, 0.3) + rng.uniform(0, 0.002, (80, 80))
    assert segment_heights(heights, sigma_m=0.001).max() == 1


def test_flat_ground_has_no_rocks(rng: np.random.Generator) -> None:
    assert segment_heights(rng.normal(scale=0.001, size=(60, 60)), sigma_m=0.001).max() == 0
    assert segment_heights(np.full((60, 60), np.nan), sigma_m=0.0).max() == 0


def test_a_rise_whose_top_is_cut_by_the_frame_is_no_rock() -> None:
    heights = dome((80, 80), 0, 40, 30, 0.3)
    assert segment_heights(heights, sigma_m=0.001).max() == 0
    assert segment_heights(np.roll(heights, 20, axis=0), sigma_m=0.001).max() == 1


def test_small_specks_are_dropped() -> None:
    assert segment_heights(dome((40, 40), 20, 20, 3, 0.1), sigma_m=0.001).max() == 0
    assert segment_heights(dome((40, 40), 20, 20, 5, 0.1), sigma_m=0.001).max() == 1


@pytest.mark.parametrize("scale", [1.0, 0.1])
def test_rocks_are_numbered_in_reading_order(scale: float) -> None:
    heights = dome((90, 90), 20, 60, 15, 0.2) + dome((90, 90), 60, 20, 15, 0.4)
    labels = segment_heights(scale * heights, sigma_m=0.001)
    assert labels[20, 60] == 1
    assert labels[60, 20] == 2


def test_peaks_of_equal_height_on_one_ridge_are_one_top() -> None:
    heights = dome((80, 120), 40, 60, 30, 0.3)
    ridge = np.full((80, 120), np.inf)
    ridge[:, ::2] = 0.2
    ridge[:, 1::2] = 0.199  # less than a level below, but in another one
    assert segment_heights(np.minimum(heights, ridge), sigma_m=0.001).max() == 1
