"""Colour: radiance of spheres in closed form, dust, and what a dataset in colour holds."""

import cv2
import numpy as np
import pytest

import synth
from synth.camera.pose import look_at
from synth.camera.presets import PRESETS
from synth.dataset.normals import decode_normals, encode_normals
from synth.light import light_scene
from synth.light.colour import LUMINANCE, Appearance, tint
from synth.light.photometry import towards_sun
from synth.render import open_renderer
from synth.render.view import render_view
from synth.rocks.ellipsoid import ellipsoid
from synth.scene.finish import Finish
from synth.scene.ground import make_ground
from synth.scene.laying import PlacedRock
from synth.scene.scene import SceneModel
from synth.spec.ground import GroundSpec
from synth.spec.surface import SurfaceSpec
from synth.spec.view import SunSpec

RADIUS_M, ALBEDO = 0.4, 0.3
ROCK_RGB, GROUND_RGB, DUST_RGB = (0.30, 0.15, 0.09), (0.3, 0.27, 0.2), (0.36, 0.25, 0.12)
SUN_RGB, SKY_RGB = (1.0, 0.95, 0.85), (0.6, 0.8, 1.0)
SUN = SunSpec(azimuth_deg=30.0, elevation_deg=50.0, ambient=0.4)
CENTRE_M = np.array([0.0, 0.0, RADIUS_M])


def balls_view(**surface):
    """Return a ball seen by a camera, and where its pixels meet it: normals (n, 3) and mask."""
    rock = ellipsoid(np.full(3, RADIUS_M))
    placed = PlacedRock(
        rock=rock,
        model_to_world=np.eye(3),
        position_m=CENTRE_M,
        albedo=ALBEDO,
        mesh=rock.mesh.moved(np.eye(3), CENTRE_M),
        finish=Finish(lithology="red", rgb=np.array(ROCK_RGB)),
    )
    ground = make_ground(GroundSpec(), radius_m=3.0, rng=np.random.default_rng(1))
    scene = SceneModel(rocks=(placed,), camera=None, poses=(), ground=ground)
    appearance = Appearance(
        sun=tint(SUN_RGB), sky=tint(SKY_RGB), ground=tint(GROUND_RGB), dust=tint(DUST_RGB)
    )
    stage = light_scene(scene, SUN, SurfaceSpec(contrast=0.0, **surface), appearance=appearance)
    camera, pose = PRESETS["imp"].camera, look_at(np.array([4.0, -1.5, 2.5]), CENTRE_M)
    renderer = open_renderer("embree", stage, camera)
    view = render_view(renderer, stage, camera, pose, supersample=1, normals=True)
    columns, rows = np.meshgrid(np.arange(camera.width), np.arange(camera.height))
    rays = np.stack(
        [(columns - camera.cx) / camera.fx, (rows - camera.cy) / camera.fy, np.ones(rows.shape)], -1
    )
    rays = rays @ pose.world_to_camera
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    arm = pose.position_m() - CENTRE_M
    along = rays @ arm
    root = along**2 - (arm @ arm - (0.99 * RADIUS_M) ** 2)  # the rim's facets are left out
    normals = arm + (-along - np.sqrt(along**2 - arm @ arm + RADIUS_M**2))[..., None] * rays
    return view, normals / RADIUS_M, root > 0.0, pose


def light_on(normals):
    """Return the light of a Lambertian white surface, (n, 3), without its own shadow's edge."""
    sky = SUN.ambient * (1.0 - 0.6 * (1.0 - normals[:, 2]) / 2.0)
    sun = (1.0 - SUN.ambient) * np.maximum(normals @ towards_sun(SUN), 0.0) / towards_sun(SUN)[2]
    return 1.35 * (sky[:, None] * tint(SKY_RGB) + sun[:, None] * tint(SUN_RGB))


@pytest.mark.filterwarnings("ignore:invalid value")
def test_a_balls_radiance_in_three_colours_is_lamberts():
    view, normals, seen, pose = balls_view()
    assert seen.sum() > 3000
    expected = light_on(normals[seen]) * ALBEDO * tint(ROCK_RGB)
    np.testing.assert_allclose(view.colour[seen], expected, atol=2e-3)
    np.testing.assert_allclose(view.light, view.colour @ LUMINANCE, rtol=1e-5)
    camera_normals = normals[seen] @ pose.world_to_camera.T
    np.testing.assert_allclose(view.normals[seen], camera_normals, atol=2e-3)
    assert (camera_normals[:, 2] < 0.0).all()


@pytest.mark.filterwarnings("ignore:invalid value")
def test_dust_lies_on_what_faces_up_in_its_own_colour():
    view, normals, seen, _ = balls_view(dust=0.7, ground_albedo=0.5)
    cover = 0.7 * np.clip((normals[seen, 2] - 0.4) / 0.6, 0.0, 1.0)[:, None]
    bare, dust = ALBEDO * tint(ROCK_RGB), 0.5 * tint(DUST_RGB)
    expected = light_on(normals[seen]) * ((1.0 - cover) * bare + cover * dust)
    np.testing.assert_allclose(view.colour[seen], expected, atol=3e-3)


def test_a_tint_has_luminance_one():
    assert tint((0.2, 0.1, 0.4)) @ LUMINANCE == pytest.approx(1.0, rel=1e-12)


def test_normals_come_back_from_sixteen_bits():
    normals = np.random.default_rng(1).standard_normal((50, 40, 3)).astype(np.float32)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    normals[3, 4] = np.nan
    np.testing.assert_allclose(decode_normals(encode_normals(normals)), normals, atol=2e-5)


@pytest.fixture(scope="module")
def scene():
    return synth.make_scene(
        site="plain",
        rocks=2,
        camera="imp",
        views=1,
        seed=3,
        renderer="embree",
        image={"colour": True},
    )


def test_a_dataset_in_colour_has_rgb_beside_gray(scene, tmp_path):
    scene.write(tmp_path / "out")
    folder = tmp_path / "out" / "000000"
    view = scene.render(0)
    rgb = cv2.imread(str(folder / "rgb" / "000000.png"), cv2.IMREAD_UNCHANGED)[..., ::-1]
    np.testing.assert_array_equal(view.image, rgb)
    grey = cv2.imread(str(folder / "gray" / "000000.png"), cv2.IMREAD_UNCHANGED)
    np.testing.assert_array_equal(view.pictures["gray"], grey)
    clear = (rgb < 250).all(axis=-1)
    np.testing.assert_allclose((rgb @ LUMINANCE)[clear], grey[clear].astype(float), atol=1.0)
    assert '"rgb/000000.png"' in (folder / "scene_gt_coco.json").read_text()
    assert not (folder / "normals").exists()
