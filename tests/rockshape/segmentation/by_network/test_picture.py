"""Pictures as the network sees them: alike in any exposure."""

import numpy as np

from rockshape.segmentation.by_network.picture import as_fractions, normalized


def _picture(seed: int = 0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    coarse = rng.uniform(0.2, 0.8, (12, 16, 3))
    return np.kron(coarse, np.ones((10, 10, 1))).astype(np.float32)


def test_half_the_light_changes_nothing_by_more_than_a_tenth():
    bright, dark = normalized(_picture()), normalized(0.5 * _picture())
    assert np.abs(bright[0] - dark[0]).max() < 0.1
    assert np.corrcoef(bright[1].ravel(), dark[1].ravel())[0, 1] > 0.99


def test_a_grey_picture_has_no_colour_and_a_coloured_one_has():
    grey = _picture()[..., 0]
    assert not normalized(grey)[1:].any()
    same = normalized(np.repeat(grey[..., None], 3, axis=-1))
    np.testing.assert_allclose(normalized(grey), same, atol=1e-5)
    assert np.abs(normalized(_picture())[1:]).max() > 0.5


def test_an_even_picture_stays_even():
    assert np.abs(normalized(np.full((40, 60), 0.3, dtype=np.float32))).max() < 0.05


def test_whole_numbers_of_any_range_become_fractions():
    eight = (255 * _picture()).astype(np.uint8)
    twelve = (eight.astype(np.uint16)) * 16
    assert np.abs(as_fractions(eight) - as_fractions(twelve)).max() < 1e-6
    assert as_fractions(eight).max() <= 1.2
    holes = _picture()
    holes[0, 0] = np.nan
    assert np.isfinite(as_fractions(holes)).all()
    assert not as_fractions(np.full((5, 5), np.nan)).any()
    assert not as_fractions(np.zeros((5, 5), dtype=np.uint8)).any()
