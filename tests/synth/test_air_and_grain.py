"""Sky and veil of dusty air; fine relief of rocks; the rocks that a site brings."""

import numpy as np
import pytest
from scipy import integrate
from scipy.spatial.transform import Rotation

from synth.light.air import Air
from synth.light.rock_relief import rock_relief
from synth.spec import convert_spec
from synth.spec.site import with_site

GREY = np.ones(1, dtype=np.float32)


def _rays(elevations_rad):
    rays = np.column_stack([np.cos(elevations_rad), 0.0 * elevations_rad, np.sin(elevations_rad)])
    return (3.0 * rays).astype(np.float32)


def test_a_dusty_sky_gives_level_ground_its_share_of_the_light():
    air = Air(GREY, ambient=0.36, haze_m=2000.0)

    def arriving(elevation_rad):
        sky = air.sky(_rays(np.array([elevation_rad])))[0, 0]
        return 2.0 * sky * np.sin(elevation_rad) * np.cos(elevation_rad)

    total, _ = integrate.quad(arriving, 0.0, np.pi / 2.0)
    assert total == pytest.approx(1.35 * 0.36, rel=0.1)
    horizon, zenith = air.sky(_rays(np.array([0.0, np.pi / 2.0])))[:, 0]
    assert horizon > 1.2 * zenith


def test_what_is_far_fades_into_the_horizon():
    air = Air(GREY, ambient=0.36, haze_m=2000.0)
    horizon = air.sky(_rays(np.zeros(1)))[0, 0]
    seen = air.veiled(np.full((3, 1), 0.1, np.float32), np.array([0.0, 2000.0, 1e6], np.float32))
    share = 1.0 - np.exp(-1.0)
    expected = [0.1, 0.1 + share * (horizon - 0.1), horizon]
    np.testing.assert_allclose(seen[:, 0], expected, rtol=1e-5)


def test_clear_air_veils_nothing():
    air = Air(GREY, ambient=0.3)
    light = np.full((2, 1), 0.2, np.float32)
    assert air.veiled(light, np.array([1.0, 1e6], np.float32)) is light
    assert (air.sky(_rays(np.linspace(0.0, 1.5, 9))) == np.float32(0.75)).all()


def test_grain_has_the_slope_asked_for_and_is_averaged_over_a_footprint():
    turn = Rotation.from_rotvec([0.3, -1.1, 0.4]).as_matrix()
    place_m = np.array([1.0, 2.0, 0.5])
    rng = np.random.default_rng(1)
    own_m = rng.uniform(-0.5, 0.5, (20_000, 3)) * [1.0, 1.0, 0.0]
    points_m = (own_m @ turn.T + place_m).astype(np.float32)
    normal = np.tile(turn[:, 2], (len(points_m), 1)).astype(np.float32)
    relief = rock_relief(turn, place_m, 0.3)

    def slopes(footprint_m):
        rough = relief(points_m, normal, np.full(len(points_m), footprint_m, np.float32))
        np.testing.assert_allclose(np.linalg.norm(rough, axis=1), 1.0, atol=1e-5)
        cosines = np.einsum("ij,ij->i", rough, normal)
        return float(np.sqrt((1.0 / cosines**2 - 1.0).mean()))

    assert slopes(0.0005) == pytest.approx(0.3, rel=0.12)
    assert slopes(0.064) < 0.08
    assert rock_relief(turn, place_m, 0.0) is None


def test_a_site_brings_its_rocks_unless_forms_are_said():
    site = convert_spec(with_site({}, where="test"), where="test").rocks
    assert (site.family, site.count) == ("field", 6)
    said = convert_spec(with_site({"rocks": {"series": "graded"}}, where="test"), where="test")
    assert (said.rocks.family, said.rocks.series) == ("rounded-polyhedron", "graded")
    balls = convert_spec(with_site({"rocks": {"family": "ellipsoid"}}, where="test"), where="test")
    assert balls.rocks.family == "ellipsoid"
    assert balls.rocks.albedo == site.albedo
