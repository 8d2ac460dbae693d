"""Kurtosis of a shading's gradient, and what range and shading tell together."""

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter

from rockshape.measures.angularity_3d import angularity_3d
from rockshape.rock.shading import SMOOTHING, gradient_kurtosis
from rockshape.surface import Relief, weigh_edges

SIZE = 161
Y, X = np.mgrid[:SIZE, :SIZE] - SIZE // 2
DISC = np.hypot(X, Y) < 75


def told(kurtosis: float) -> float:
    """What shading alone tells."""
    return 1.7 * float(np.log(kurtosis / 2))


def relief(angularity: float, noise: float) -> Relief:
    return Relief(angularity**3, noise, rough=0.01, noise_rough=0.0, facing=5000)


def faces(width_px: float) -> np.ndarray:
    """Three faces of one brightness each, the edges between them of a width."""
    bright = np.select([X + 0.3 * Y < -20, X - 0.4 * Y < 25], [0.2, 0.5], 0.9)
    return gaussian_filter(bright, width_px, mode="nearest")


def test_a_random_field_has_two(rng: np.random.Generator) -> None:
    fields = [gaussian_filter(rng.standard_normal((SIZE, SIZE)), 3.0) for _ in range(40)]
    found = [gradient_kurtosis(field, DISC) for field in fields]
    assert np.mean(found) == pytest.approx(2, abs=0.1)


def test_a_plane_of_brightness_has_one() -> None:
    assert gradient_kurtosis(0.01 * X, DISC) == pytest.approx(1, abs=0.01)


def test_of_one_edge_it_is_what_a_smoothed_step_has() -> None:
    # along x the gradient is a Gaussian of the smoothing's length s, over a strip 2 w wide:
    # of a step the fourth moment over the square of the second is 2 w/(s sqrt(2 pi))
    half = 60
    strip = np.ones((2 * half + 1, 2 * half + 1), dtype=bool)
    across = np.arange(-half, half + 1)
    step = 0.2 + 0.6 * np.tile((across > 0) + 0.5 * (across == 0), (len(across), 1))
    length = SMOOTHING * np.sqrt(strip.sum() / np.pi)
    inner = 2 * half + 1 - 2 * np.ceil(1.5 * length - 1)
    expected = inner / (length * np.sqrt(2 * np.pi))
    assert gradient_kurtosis(step, strip) == pytest.approx(expected, rel=0.05)


def test_sharper_edges_have_more() -> None:
    found = [gradient_kurtosis(faces(width), DISC) for width in (0.1, 3.0, 6.0, 12.0, 24.0)]
    assert found == sorted(found, reverse=True)
    assert found[0] > 2 * found[-1]


def test_contrast_brightness_and_surroundings_do_not_count(rng: np.random.Generator) -> None:
    image = faces(3.0)
    whole = gradient_kurtosis(image, DISC)
    assert gradient_kurtosis(0.2 * image + 0.4, DISC) == pytest.approx(whole, rel=1e-6)
    around = np.where(DISC, image, rng.uniform(size=image.shape))
    assert gradient_kurtosis(around, DISC) == pytest.approx(whole, rel=1e-9)
    assert gradient_kurtosis(np.where(DISC, image, np.nan), DISC) == pytest.approx(whole, rel=1e-9)


@pytest.mark.parametrize("times", [2, 4, 8])
def test_a_larger_picture_tells_the_same(times: int) -> None:
    image, mask = (np.kron(one, np.ones((times, times))) for one in (faces(4.0), DISC))
    whole = gradient_kurtosis(faces(4.0), DISC)
    assert gradient_kurtosis(image, mask.astype(bool)) == pytest.approx(whole, rel=0.1)


@pytest.mark.parametrize("level", [0.3, 0.5, 77 / 255, 1.0, 0.0, np.nan])
def test_none_of_a_flat_picture(level: float) -> None:
    assert np.isnan(gradient_kurtosis(np.full((SIZE, SIZE), level), DISC))


def test_none_of_one_odd_pixel_or_a_small_rock() -> None:
    odd = np.full((SIZE, SIZE), 0.3)
    odd[80, 80] += 1 / 255
    assert np.isnan(gradient_kurtosis(odd, DISC))
    assert np.isnan(gradient_kurtosis(faces(1.0), np.hypot(X, Y) < 5))
    assert np.isnan(gradient_kurtosis(faces(1.0), np.zeros_like(DISC)))


@pytest.mark.parametrize("unlit", [0.0, 1.0, np.nan, np.inf])
def test_what_is_not_lit_has_no_edges(unlit: float, rng: np.random.Generator) -> None:
    field = 0.5 + gaussian_filter(rng.standard_normal((SIZE, SIZE)), 3.0)
    shaded = np.where(np.abs(X + 20) < 12, unlit, field)
    parts = DISC & (np.abs(X + 20) >= 12)
    assert gradient_kurtosis(shaded, DISC) == gradient_kurtosis(field, parts)
    assert gradient_kurtosis(shaded, DISC) < 3


def test_exact_range_alone_counts() -> None:
    for angularity in (0.0, 0.4, 2.5):
        found = weigh_edges(relief(angularity, 0.0), kurtosis=9.0)
        assert found == pytest.approx(angularity, abs=1e-6)
        assert relief(angularity, 0.0).resolves_edges


def test_in_noise_shading_alone_counts() -> None:
    found = weigh_edges(relief(1.0, 1e6), kurtosis=5.0)
    assert found == pytest.approx(told(5.0), abs=1e-3)
    assert not relief(1.0, 1e6).resolves_edges
    # range alone has no value above a noise of 2.2³
    assert not relief(1.0, 10.7).resolves_edges
    assert relief(1.0, 10.6).resolves_edges
    # less than a random field has tells of no edge
    assert weigh_edges(relief(1.0, 1e6), kurtosis=1.2) == pytest.approx(0, abs=1e-3)


@pytest.mark.parametrize(("angularity", "noise"), [(2.2, 4.0), (0.5, 0.3), (1.4, 20.0), (0.0, 1.0)])
def test_between_them_it_is_the_most_likely(angularity: float, noise: float) -> None:
    steps = np.linspace(0, 5, 50_001)
    misfit = ((angularity**3 - steps**3) / noise) ** 2 + ((steps - told(4.0)) / 0.85) ** 2
    found = angularity_3d(relief(angularity, noise), kurtosis=4.0)
    assert found == pytest.approx(steps[np.argmin(misfit)], abs=2e-4)
    ends = sorted((angularity, told(4.0)))
    assert ends[0] <= found <= ends[1]


def test_bends_that_go_inwards_lower_it() -> None:
    inwards = Relief(-20.0, 3.0, rough=0.01, noise_rough=0.0, facing=5000)
    assert 0 <= angularity_3d(inwards, kurtosis=4.0) < 0.6 * told(4.0)


def test_without_shading_noise_hides_edges() -> None:
    assert angularity_3d(relief(2.0, 9.0)) == pytest.approx(2)
    assert np.isnan(angularity_3d(relief(2.0, 11.0)))
    few = Relief(8.0, 0.0, rough=0.01, noise_rough=0.0, facing=100)
    assert np.isnan(angularity_3d(few, kurtosis=5.0))
