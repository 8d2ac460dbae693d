"""Crops of tiles: picture and labels stay on one another, and a generator decides all."""

import numpy as np

from training.augment import draw_crop
from training.tile import SIDE_PX, Tile, cut_tiles


def _tile() -> Tile:
    labels = np.zeros((SIDE_PX, SIDE_PX), dtype=np.uint16)
    labels[40:120, 60:200] = 1
    labels[150:240, 20:90] = 2
    image = np.repeat(np.where(labels > 0, 200, 60).astype(np.uint8)[..., None], 3, axis=-1)
    return Tile(image, labels)


def test_the_picture_is_bright_where_the_labels_have_a_rock():
    for seed in range(40):
        picture, labels = draw_crop(_tile(), 128, np.random.default_rng(seed), plain=True)
        assert picture.shape == (128, 128, 3)
        rock = labels > 0
        if 0.1 < rock.mean() < 0.9:
            grey = picture.mean(axis=-1)
            agree = np.corrcoef(grey.ravel(), rock.ravel())[0, 1]
            assert agree > 0.7


def test_a_generator_in_the_same_state_draws_the_same_crop():
    one, two = (draw_crop(_tile(), 96, np.random.default_rng(5)) for _ in range(2))
    assert np.array_equal(one[0], two[0])
    assert np.array_equal(one[1], two[1])


def test_tiles_are_cut_from_the_middle_and_numbered_afresh():
    labels = np.zeros((SIDE_PX + 10, 2 * SIDE_PX + 6), dtype=np.uint16)
    labels[100, 100], labels[200, 400] = 700, 900
    image = np.repeat((labels > 0).astype(np.uint8)[..., None], 3, axis=-1)
    left, right = cut_tiles(image, labels)
    assert left.labels[95, 97] == right.labels[195, 400 - 3 - SIDE_PX] == 1
    assert left.image[95, 97, 0] == 1
    assert left.labels.max() == right.labels.max() == 1
