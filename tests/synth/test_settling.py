"""Populations, places, burial and resting: laws and closed forms."""

import numpy as np
import pytest
from scipy.integrate import quad

from synth.camera.pose import look_at
from synth.camera.projection import project
from synth.camera.trajectories import camera_of, stations
from synth.errors import SpecError
from synth.geometry.mesh import volume_m3
from synth.rocks.ellipsoid import ellipsoid
from synth.scene.ground import make_ground
from synth.scene.population import covered_share, decay_per_m, draw_diameters_m, number_per_m2
from synth.scene.scene import build_scene
from synth.scene.settling import buried_fraction, mean_above
from synth.spec import convert_spec
from synth.spec.ground import GroundSpec
from synth.spec.population import PopulationSpec
from synth.spec.view import CameraSpec, ViewsSpec

FIELD = {
    "population": {"kind": "golombek-rapp", "k": 0.05, "d_min_m": 0.25, "radius_m": 2.0},
    "rocks": {"family": "rounded-box", "series": "random"},
}


def test_the_number_of_rocks_is_the_integral_of_their_density():
    k = 0.19
    q = decay_per_m(k)
    assert q == pytest.approx(2.59)
    density = lambda d: q * covered_share(d, k) / (np.pi * d**2 / 4)  # noqa: E731
    # The quadrature's own error is 1e-8 of the value.
    expected = quad(density, 0.1, 30.0, epsabs=0.0, limit=200)[0]
    assert number_per_m2(0.1, k) == pytest.approx(expected, rel=1e-6)


def test_a_field_has_the_counts_of_the_formula(rng):
    spec = PopulationSpec(k=0.19, d_min_m=0.1, d_max_m=2.0, radius_m=4.0)
    counts = np.zeros(2)
    fields = 60
    for _ in range(fields):
        diameters_m = draw_diameters_m(spec, rng=rng)
        assert (np.diff(diameters_m) <= 0).all()
        assert diameters_m.min() >= 0.1
        counts += [len(diameters_m), (diameters_m >= 0.4).sum()]
    ends = number_per_m2(np.array([0.1, 0.4, 2.0]), spec.k)
    means = (ends[:2] - ends[2]) * np.pi * 16 * fields
    # Four standard deviations of a Poisson number: one false alarm in 16,000.
    assert (np.abs(counts - means) < 4 * np.sqrt(means)).all()


@pytest.mark.parametrize("layout", ["uniform", "clustered"])
def test_a_population_lies_apart(layout):
    table = {**FIELD, "population": {**FIELD["population"], "layout": layout}}
    scene = build_scene(convert_spec(table, where="test"), 0)
    places = np.array([placed.position_m[:2] for placed in scene.rocks])
    reaches = [
        np.linalg.norm((p.mesh.vertices_m - p.position_m)[:, :2], axis=1).max() for p in scene.rocks
    ]
    gaps = np.linalg.norm(places[:, None] - places, axis=2) - np.add.outer(reaches, reaches)
    assert gaps[~np.eye(len(places), dtype=bool)].min() >= -1e-9
    assert np.hypot(*places.T).max() <= 2.0


def test_full_ground_tells_how_many_rocks_fit():
    table = {
        "population": {"kind": "golombek-rapp", "k": 0.5, "d_min_m": 0.3, "radius_m": 1.2,
                       "layout": "clustered", "cluster_radius_m": 0.2},
        "rocks": {"family": "rounded-box", "series": "random"},
    }  # fmt: skip
    with pytest.raises(SpecError, match=r"population\.k: the ground is full: \d+ rocks fit"):
        build_scene(convert_spec(table, where="test"), 0)


def test_the_part_of_a_ball_below_ground_is_a_cap():
    mesh = ellipsoid(np.ones(3)).mesh
    for depth in (0.2, 0.7, 1.0):
        # A cap of height h has h²(3 − h)π/3 of 4π/3.
        found = buried_fraction(mesh, mesh.vertices_m[:, 2] + 1.0 - depth)
        # The mesh lacks 2e-4 of the ball's volume.
        assert found == pytest.approx(depth**2 * (3 - depth) / 4, abs=2e-4)
    assert volume_m3(mesh) == pytest.approx(4 * np.pi / 3, rel=1e-3)


def test_mean_above_is_the_integral(rng):
    corners = rng.uniform(-1, 1, size=(40, 3))
    share = np.sort(rng.uniform(size=(200_000, 2)), axis=1)
    weights = np.column_stack([share[:, 0], share[:, 1] - share[:, 0], 1 - share[:, 1]])
    sampled = np.maximum(weights @ corners.T, 0).mean(axis=0)
    # 200,000 samples of spread below 0.6 leave 1.3e-3; four of them.
    np.testing.assert_allclose(mean_above(corners), sampled, atol=6e-3)


@pytest.mark.parametrize("ground", [{"slope_deg": 10.0}, {"ripple_height_m": 0.02}])
def test_burial_is_a_share_of_the_height(ground):
    table = {"ground": {**ground, "burial": [0.3, 0.3], "resting": "stable"},
             "rocks": {"count": 2, "family": "rounded-box"}}  # fmt: skip
    scene = build_scene(convert_spec(table, where="test"), 0)
    for placed in scene.rocks:
        vertices = placed.mesh.vertices_m
        clearances = vertices[:, 2] - scene.ground.heights_m(vertices[:, :2])
        share = -clearances.min() / np.ptp(clearances)
        # On ripples a foot sinks by their height besides, 2 cm of 20 or so.
        assert share == pytest.approx(0.3, abs=1e-9 if "slope_deg" in ground else 0.1)
        assert 0.1 < placed.buried_fraction < 0.5


def test_features_do_not_reshuffle_the_rest():
    plain = build_scene(convert_spec({}, where="test"), 0)
    table = {"ground": {"pebbles_per_m2": 5.0, "burial": [0.0, 0.3]}, "surface": {"dust": 0.5}}
    dressed = build_scene(convert_spec(table, where="test"), 0)
    for one, two in zip(plain.rocks, dressed.rocks, strict=True):
        np.testing.assert_array_equal(one.position_m[:2], two.position_m[:2])
        assert one.albedo == two.albedo


def test_ripples_have_their_height():
    ground = make_ground(
        GroundSpec(ripple_height_m=0.03), radius_m=3.0, rng=np.random.default_rng(5)
    )
    side = np.linspace(-1.5, 1.5, 400)
    z = ground.heights_m(np.stack(np.meshgrid(side, side), axis=-1))
    # Crest at 1.2, trough at −0.8 of half the height: the second harmonic moves both up.
    assert np.ptp(z) == pytest.approx(0.03, rel=0.02)
    assert ground.plane_normal() is None


def test_paths_look_at_the_target():
    spec = CameraSpec(target_m=(0.3, 0.2, 0.1), roll_deg=15.0)
    camera = camera_of(spec)
    for path in ("ring", "arc", "drive-by"):
        poses = stations(spec, ViewsSpec(count=3, path=path))
        for pose in poses:
            centre = project(camera, pose.camera_points_m(np.array([0.3, 0.2, 0.1])))
            np.testing.assert_allclose(centre, [camera.cx, camera.cy], atol=1e-9)
        if path == "drive-by":
            steps = np.diff([pose.position_m() for pose in poses], axis=0)
            np.testing.assert_allclose(steps[0], steps[1], atol=1e-12)
            assert np.linalg.norm(steps.sum(axis=0)) == pytest.approx(3.0)


def test_a_pan_turns_about_its_mast():
    spec, views = CameraSpec(distance_m=4.0), ViewsSpec(count=7, path="pan", arc_deg=72.0)
    poses = stations(spec, views)
    axes = np.array([pose.world_to_camera[2] for pose in poses])  # forward, in the world
    np.testing.assert_allclose(
        [pose.position_m() for pose in poses], [poses[0].position_m()] * 7, atol=1e-12
    )
    np.testing.assert_allclose(axes[:, 2], axes[0, 2], atol=1e-12)
    bearings = np.unwrap(np.arctan2(axes[:, 1], axes[:, 0]))
    np.testing.assert_allclose(np.rad2deg(np.diff(bearings)), 12.0, atol=1e-9)
    camera = camera_of(spec)
    centre = project(camera, poses[3].camera_points_m(np.zeros(3)))
    np.testing.assert_allclose(centre, [camera.cx, camera.cy], atol=1e-9)


def test_a_roll_turns_the_horizon():
    pose = look_at(np.array([4.0, 0.0, 2.0]), np.zeros(3), roll_rad=np.pi / 6)
    up = pose.world_to_camera @ np.array([0.0, 0.0, 1.0])
    # Clockwise camera, anticlockwise image: up leans to the left (−x), y points down.
    assert np.arctan2(up[0], -up[1]) == pytest.approx(-np.pi / 6)
