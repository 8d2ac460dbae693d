"""Things over crops: where one is drawn there is no rock, and elsewhere nothing changes."""

import numpy as np

from training.things import with_things


def _crop() -> tuple[np.ndarray, np.ndarray]:
    labels = np.ones((96, 96), dtype=np.uint16)
    return np.full((96, 96, 3), 0.4321, dtype=np.float32), labels


def test_what_is_drawn_is_no_rock():
    picture, labels = _crop()
    drawn = 0
    for seed in range(400):
        found, left = with_things(picture, labels, np.random.default_rng(seed))
        changed = (found != picture).any(axis=-1)
        # an edge is smooth: next to a thing a pixel of rock may have some of its colour
        inner = changed[1:-1, 1:-1] & changed[:-2, 1:-1] & changed[2:, 1:-1]
        inner &= changed[1:-1, :-2] & changed[1:-1, 2:]
        assert not left[1:-1, 1:-1][inner].any()
        assert set(np.unique(left)) <= {0, 1}
        drawn += changed.any()
    assert 20 < drawn < 90


def test_the_crop_that_is_given_stays_as_it_is():
    picture, labels = _crop()
    for seed in range(60):
        with_things(picture, labels, np.random.default_rng(seed))
    assert (picture == np.float32(0.4321)).all()
    assert (labels == 1).all()
