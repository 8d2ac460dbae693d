"""Echo of a sensor's own light: from every kind of surface, as strong as it reflects."""

from types import SimpleNamespace

import numpy as np
import pytest

from synth.camera.camera import RenderCamera
from synth.camera.pose import look_at
from synth.light import light_scene
from synth.light.colour import LUMINANCE
from synth.render import open_renderer, render_view
from synth.scene.ground import make_ground
from synth.scene.scene import SceneModel
from synth.scene.thing_placement import place_things
from synth.sensor.echo import echo_of
from synth.spec.ground import GroundSpec
from synth.spec.surface import SurfaceSpec
from synth.spec.terrain import TerrainSpec
from synth.spec.things import ThingsSpec
from synth.spec.view import SunSpec

CAMERA = RenderCamera(fx=200.0, fy=200.0, cx=79.5, cy=79.5, width=160, height=160)
EYE_M = np.array([0.05, 0.0, 1.5])
POSE = look_at(EYE_M, np.zeros(3))
GREY = 0.4


def reflected(spec, things=()):
    """Return signal × r² of each pixel, a surface's ρ cos θ, and the cosine at level ground."""
    ground = make_ground(spec, radius_m=1.0, rng=np.random.default_rng(1))
    placed = place_things(
        ThingsSpec(kinds=things), ground, [], reach_m=0.15, rng=np.random.default_rng(2)
    )
    scene = SceneModel(rocks=(), camera=CAMERA, poses=(POSE,), ground=ground, things=placed)
    stage = light_scene(scene, SunSpec(), SurfaceSpec(ground_albedo=GREY))
    view = render_view(open_renderer("embree", stage, CAMERA), stage, CAMERA, POSE, supersample=1)
    echo = echo_of(SimpleNamespace(camera=CAMERA, stage=stage, pose=POSE, view=view))
    return echo.signal * echo.range_m**2, EYE_M[2] / echo.range_m, placed


def test_plain_ground_reflects_its_albedo():
    found, cosine, _ = reflected(GroundSpec())
    np.testing.assert_allclose(found, GREY * cosine, rtol=1e-3)


def test_rough_ground_reflects_what_its_soil_does():
    soil = (0.3, 0.2, 0.1)
    found, cosine, _ = reflected(GroundSpec(terrain=TerrainSpec(soil=soil)))
    np.testing.assert_allclose(found, np.array(soil) @ LUMINANCE * cosine, rtol=2e-3)


def test_a_thing_reflects_its_own_albedo():
    found, cosine, (ball,) = reflected(GroundSpec(), things=("ball",))
    elsewhere = np.abs(found - GREY * cosine) > 0.01
    assert 50 < elsewhere.sum() < found.size / 2
    albedo = np.array(ball.model.rgb) @ LUMINANCE
    assert found[elsewhere].max() == pytest.approx(albedo, rel=0.02)
