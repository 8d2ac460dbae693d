"""Time of flight: mixed pixels, steps, saturation and the range's repetition."""

import numpy as np
import pytest

from synth.sensor.echo import Echo
from synth.sensor.tof import TofOptions, tof_range_m, unambiguous_m

QUIET = {"sd_m": 0.0, "step_m": 0.0, "saturation": 100.0, "min_signal": 0.0}


def told_m(range_m, signal, rng, **options):
    echo = Echo(np.asarray(range_m, dtype=float), np.asarray(signal, dtype=float))
    return tof_range_m(echo, TofOptions(**{**QUIET, **options}), rng=rng)


def step_edge(near_m, far_m):
    range_m = np.full((9, 20), far_m)
    range_m[:, :10] = near_m
    return range_m


def test_a_flat_surface_keeps_its_range(rng):
    found = told_m(np.full((8, 8), 3.21), np.full((8, 8), 0.1), rng, footprint_px=3.0)
    np.testing.assert_allclose(found, 3.21, atol=1e-12)


@pytest.mark.parametrize("footprint_px", [2.0, 2.6])
def test_a_step_edge_flies_between_its_sides(rng, footprint_px):
    """A pixel at the edge sees w − 1 halves of a pixel beyond it: phasors add with that share."""
    near_m, far_m, near_signal, far_signal = 2.0, 3.0, 0.25, 0.05
    signal = np.where(step_edge(1.0, 0.0) > 0, near_signal, far_signal)
    found = told_m(step_edge(near_m, far_m), signal, rng, footprint_px=footprint_px)
    turn = 2.0 * np.pi / unambiguous_m(TofOptions())
    beyond = (footprint_px - 1.0) / 2.0 / footprint_px
    for column, share in ((9, 1.0 - beyond), (10, beyond)):
        near = share * near_signal * np.exp(1j * turn * near_m)
        far = (1.0 - share) * far_signal * np.exp(1j * turn * far_m)
        np.testing.assert_allclose(found[:, column], np.angle(near + far) / turn, atol=1e-12)
    np.testing.assert_allclose(found[:, :9], near_m, atol=1e-12)
    np.testing.assert_allclose(found[:, 11:], far_m, atol=1e-12)


def test_a_footprint_of_one_pixel_mixes_nothing(rng):
    edge_m = step_edge(2.0, 3.0)
    np.testing.assert_allclose(
        told_m(edge_m, np.full(edge_m.shape, 0.1), rng, footprint_px=1.0), edge_m, atol=1e-12
    )


def test_bright_and_lost_pixels_are_holes(rng):
    signal = np.array([[0.5, 1.5, 1e-5, 0.0]])
    range_m = np.array([[2.0, 2.0, 2.0, np.nan]])
    found = told_m(range_m, signal, rng, footprint_px=1.0, saturation=1.0, min_signal=1e-4)
    np.testing.assert_array_equal(np.isnan(found), [[False, True, True, True]])


def test_range_comes_in_steps_and_repeats(rng):
    whole_m = unambiguous_m(TofOptions(modulation_mhz=30.0))
    assert whole_m == pytest.approx(4.9965, abs=1e-4)  # c/(2 × 30 MHz)
    range_m = np.full((3, 3), 6.2)
    found = told_m(range_m, np.full((3, 3), 0.1), rng, modulation_mhz=30.0, step_m=0.001)
    np.testing.assert_allclose(found, 6.2 - whole_m, atol=0.0005)
    np.testing.assert_allclose(found * 1000, np.rint(found * 1000), atol=1e-9)


def test_noise_goes_as_the_root_of_the_signal(rng):
    for signal in (0.01, 0.25):
        found = told_m(
            np.full((300, 300), 3.0), np.full((300, 300), signal), rng, sd_m=0.001, footprint_px=1.0
        )
        # 90,000 values: σ is known to 0.24 %; four of them.
        assert found.std() == pytest.approx(0.001 / np.sqrt(signal), rel=0.01)


def test_stray_light_draws_a_dim_hole_towards_its_bright_surroundings(rng):
    range_m, signal = np.full((121, 121), 2.0), np.full((121, 121), 0.25)
    range_m[50:71, 50:71], signal[50:71, 50:71] = 3.0, 0.01
    found = told_m(range_m, signal, rng, footprint_px=1.0, scatter=0.05, scatter_px=20.0)
    assert 2.0 < found[60, 60] < 2.9
    assert found[5, 5] == pytest.approx(2.0, abs=0.005)
