"""Light: shadows where geometry puts them, laws in closed form, texture at every pixel scale."""

import numpy as np
import pytest

from synth.camera.pose import look_at
from synth.camera.presets import PRESETS
from synth.light import light_scene
from synth.light.photometry import light, reflected, towards_sun
from synth.light.texture import pattern
from synth.render import open_renderer
from synth.render.view import render_light
from synth.rocks.ellipsoid import ellipsoid
from synth.scene.ground import make_ground
from synth.scene.laying import PlacedRock
from synth.scene.scene import SceneModel, build_scene
from synth.spec import convert_spec
from synth.spec.ground import GroundSpec
from synth.spec.surface import SurfaceSpec
from synth.spec.view import SunSpec

RADIUS_M = 0.4


def ball(place_m):
    """Return a ball of 0.4 m resting at a place."""
    centre_m = np.array([*place_m, RADIUS_M])
    rock = ellipsoid(np.full(3, RADIUS_M))
    mesh = rock.mesh.moved(np.eye(3), centre_m)
    return PlacedRock(
        rock=rock, model_to_world=np.eye(3), position_m=centre_m, albedo=0.5, mesh=mesh
    )


def stage_of(*places, sun, **ground):
    lie = make_ground(GroundSpec(**ground), radius_m=3.0, rng=np.random.default_rng(1))
    scene = SceneModel(rocks=tuple(map(ball, places)), camera=None, poses=(), ground=lie)
    return light_scene(scene, sun, SurfaceSpec())


def test_the_shadow_of_a_ball_is_the_ellipse_of_the_sun():
    # A point p of the ground is in shadow where its sun ray passes the centre nearer than R.
    sun = SunSpec(azimuth_deg=30.0, elevation_deg=35.0)
    painter = stage_of((0.2, -0.1), sun=sun).painter
    side = np.linspace(-1.6, 1.6, 161)
    places = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)
    points = np.column_stack([places, np.full(len(places), 1e-4)]).astype(np.float32)
    towards = towards_sun(sun)
    arms = np.array([0.2, -0.1, RADIUS_M]) - points
    along = arms @ towards
    passing_m = np.linalg.norm(arms - along[:, None] * towards, axis=1)
    found = painter.surfaces.blocked(points, towards.astype(np.float32))
    # The facets lie up to 0.1 mm under the sphere of 40 cm.
    sure = np.abs(passing_m - RADIUS_M) > 5e-4
    np.testing.assert_array_equal(found[sure], (passing_m < RADIUS_M)[sure])
    # The picture from the sun forgets no shadow.
    assert painter.shading.shadow_map.possible(points)[found].all()


def test_a_rock_shades_another_rock():
    sun = SunSpec(azimuth_deg=0.0, elevation_deg=20.0)
    painter = stage_of((1.0, 0.0), (0.0, 0.0), sun=sun).painter
    towards = towards_sun(sun).astype(np.float32)
    low = np.array([[0.401, 0.0, 0.40]], dtype=np.float32)  # under the shadow of the other's top
    high = np.array([[0.2, 0.0, 0.77]], dtype=np.float32)  # above it
    assert painter.surfaces.blocked(low, towards).all()
    assert not painter.surfaces.blocked(high, towards).any()


def test_bare_ground_without_an_edge_in_view_is_painted():
    stage = stage_of(sun=SunSpec())
    camera, pose = PRESETS["imp"].camera, look_at(np.array([0.0, 0.0, 3.0]), np.zeros(3))
    picture = render_light(
        open_renderer("embree", stage, camera), stage, camera, pose, supersample=2
    )
    # White ground in the sun has 1.35; the default ground gives back 0.55 of it.
    assert picture.mean() == pytest.approx(1.35 * 0.55, rel=0.1)


def test_the_laws_in_closed_form():
    incidence, emission = np.array([0.8, 0.5, -0.2]), np.array([0.6, 0.5, 0.5])
    np.testing.assert_allclose(reflected(incidence, emission, 0.0), [0.8, 0.5, 0.0])
    # Lommel and Seeliger: 2 μ₀/(μ₀ + μ), 1 where both angles are equal.
    np.testing.assert_allclose(reflected(incidence, emission, 1.0), [1.6 / 1.4, 1.0, 0.0])
    half = reflected(incidence, emission, 0.5)
    np.testing.assert_allclose(half, [(0.8 + 1.6 / 1.4) / 2, 0.75, 0.0])


@pytest.mark.parametrize("elevation_deg", [30.0, 48.0, 90.0])
def test_level_ground_has_the_same_light_at_any_sun(elevation_deg):
    sun = SunSpec(elevation_deg=elevation_deg)
    one = np.ones(1, dtype=np.float32)
    incidence = one * np.float32(towards_sun(sun)[2])
    # float32 steps by 6e-8.
    assert sum(light(one, incidence, one, sun, SurfaceSpec()))[0] == pytest.approx(1.0, rel=1e-6)
    shaded = sum(light(one, 0 * one, one, sun, SurfaceSpec()))[0]
    assert shaded == pytest.approx(sun.ambient, rel=1e-6)


def test_texture_has_contrast_at_every_pixel_scale():
    side_m = 0.5 * np.arange(256) * 0.004
    u, v = (one.ravel().astype(np.float32) for one in np.meshgrid(side_m, side_m))
    for pixels, least in ((1, 0.7), (2, 0.6), (4, 0.5), (8, 0.35)):
        footprint_m = np.full(len(u), 0.002 * pixels, dtype=np.float32)
        image = pattern(u * pixels, v * pixels, footprint_m).reshape(256, 256)
        # Differences of neighbouring pixels, what a matcher lives on: equal power in each octave
        # makes them a fixed part of the whole contrast, until the longest wave is passed.
        step = np.diff(image, axis=1).std()
        assert step > least / 3, (pixels, step)
        assert abs(image.mean()) < 0.3
    assert pattern(u, v, np.full(len(u), 0.002, dtype=np.float32)).std() == pytest.approx(
        1, abs=0.1
    )


@pytest.mark.parametrize("elevation_deg", [12.0, 32.0])
def test_the_texture_is_the_mean_over_the_pixel(elevation_deg):
    # A picture of 6 × 6 samples in each pixel is the mean to go by. Of 0.972 and 0.978 that are
    # found, one square of the geometric mean's side reaches 0.85 and 0.88.
    camera = {"preset": "imp", "distance_m": 6.0, "elevation_deg": elevation_deg}
    table = {"seed": 7, "views": {"count": 1}, "rocks": {"count": 1}, "camera": camera}
    spec = convert_spec(table, where="test")
    scene = build_scene(spec, 0)
    stage = light_scene(scene, spec.sun, spec.surface)
    pictures = []
    for camera in (scene.camera, scene.camera.refined(6)):
        renderer = open_renderer("embree", stage, camera)
        pictures.append(render_light(renderer, stage, camera, scene.poses[0], supersample=1))
    fine = pictures[1].reshape(256, 6, 256, 6).mean(axis=(1, 3))
    ground = slice(180, 250)
    assert np.corrcoef(pictures[0][ground].ravel(), fine[ground].ravel())[0, 1] > 0.95
    assert pictures[0][ground].std() == pytest.approx(fine[ground].std(), rel=0.05)
