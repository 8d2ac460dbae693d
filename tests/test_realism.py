"""Statistics and classifier of docs/realism.md: closed forms, and what both must tell."""

import sys

import numpy as np
import pytest

from tests.test_benchmarks import FOLDER


@pytest.fixture(scope="module", autouse=True)
def _importable():
    sys.path.insert(0, str(FOLDER))
    yield
    sys.path.remove(str(FOLDER))


def noise_patch(rng, power: float) -> np.ndarray:
    """Grey patch of noise whose power falls with frequency to this power."""
    frequency = np.hypot(np.fft.fftfreq(64)[:, None], np.fft.fftfreq(64))
    frequency[0, 0] = np.inf
    white = np.fft.fft2(rng.standard_normal((64, 64)))
    field = np.fft.ifft2(white * frequency ** (power / 2.0)).real
    grey = np.clip(128.0 + 30.0 * field / field.std(), 0, 255).astype(np.uint8)
    return np.repeat(grey[..., None], 3, axis=-1)


@pytest.mark.parametrize("power", [-1.0, -2.0, -3.0])
def test_the_slope_is_that_of_the_noise(rng, power):
    from picture_statistics import statistics

    slopes = [statistics(noise_patch(rng, power))[0] for _ in range(40)]
    # The lowest bands have few frequencies; the window leaks a little of them upwards.
    assert np.mean(slopes) == pytest.approx(power, abs=0.15)


def test_normal_differences_have_the_kurtosis_three(rng):
    from picture_statistics import statistics

    found = [statistics(noise_patch(rng, 0.0))[1] for _ in range(20)]
    assert np.mean(found) == pytest.approx(3.0, abs=0.1)


def test_shadow_contrast_and_saturation_of_two_halves():
    from picture_statistics import statistics

    patch = np.full((64, 64, 3), 200, dtype=np.uint8)
    patch[:16] = 50
    patch[16:, :, 2] = 100
    _, _, contrast, shadow, saturation = statistics(patch)
    bright = 0.299 * 200 + 0.587 * 200 + 0.114 * 100
    mean = 0.25 * 50 + 0.75 * bright
    assert contrast == pytest.approx(np.sqrt(0.1875) * (bright - 50) / mean)
    assert shadow == 0.25
    assert saturation == pytest.approx(0.75 * 0.5)


def test_grey_has_no_saturation(rng):
    from picture_statistics import statistics

    assert np.isnan(statistics(noise_patch(rng, -2.0))[4])


def test_the_area_under_the_curve_counts_pairs():
    from real_or_made import area_under_curve

    assert area_under_curve(np.array([3.0, 1.0]), np.array([2.0, 0.0])) == 0.75
    assert area_under_curve(np.array([1.0, 1.0]), np.array([1.0])) == 0.5


def test_the_classifier_tells_spectra_apart_and_the_same_kind_not(rng):
    from picture_statistics import descriptor
    from real_or_made import area_under_curve, train

    def described(power):
        return np.array([descriptor(noise_patch(rng, power)) for _ in range(60)])

    judge = train(described(-2.0), described(-2.6))
    apart = area_under_curve(judge.scores(described(-2.0)), judge.scores(described(-2.6)))
    alike = area_under_curve(judge.scores(described(-2.0)), judge.scores(described(-2.0)))
    assert apart > 0.97
    assert alike == pytest.approx(0.5, abs=0.16)  # 60 against 60: σ 0.053; three of them


def test_photographs_can_be_read_and_some_are_held_out():
    from real_pictures import PHOTOGRAPHS

    for photos in PHOTOGRAPHS.values():
        assert {photo.held_out for photo in photos} == {True, False}
        for photo in photos:
            picture = photo.read()
            assert picture.dtype == np.uint8
            assert min(picture.shape[:2]) >= 64
            assert picture.shape[2] == 3
