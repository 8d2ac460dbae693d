"""Painted rocks: the ground stays as it is, and all depends on the generator alone."""

import numpy as np
import pytest

from training.repaint import repainted


def _crop() -> tuple[np.ndarray, np.ndarray]:
    labels = np.zeros((80, 80), dtype=np.uint16)
    labels[10:40, 10:40], labels[50:75, 30:70] = 1, 2
    return np.full((80, 80, 3), 0.4, dtype=np.float32), labels


def test_the_ground_keeps_its_colour_but_next_to_a_rock():
    picture, labels = _crop()
    changed = 0
    for seed in range(30):
        found = repainted(picture, labels, np.random.default_rng(seed))
        apart = np.abs(found - picture).max(axis=-1)
        assert apart[:5].max() == pytest.approx(0.0, abs=1e-6)
        changed += apart[labels > 0].mean() > 0.02
    assert 5 < changed < 28


def test_rocks_are_more_often_darker_than_the_ground_than_brighter():
    picture, labels = _crop()
    means = [
        repainted(picture, labels, np.random.default_rng(seed))[labels > 0].mean()
        for seed in range(60)
    ]
    assert sum(mean < 0.38 for mean in means) > 1.5 * sum(mean > 0.42 for mean in means) > 0


def test_nothing_is_painted_without_rocks_and_a_generator_decides_all():
    picture, labels = _crop()
    bare = repainted(picture, np.zeros_like(labels), np.random.default_rng(1))
    assert np.array_equal(bare, picture)
    one, two = (repainted(picture, labels, np.random.default_rng(7)) for _ in range(2))
    assert np.array_equal(one, two)
