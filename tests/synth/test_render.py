"""The backends against closed forms and against one another, each in a process of its own."""

import importlib.util
import subprocess
import sys
from functools import cache
from itertools import combinations
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from scipy.ndimage import maximum_filter

from synth.errors import MissingBackendError
from synth.render import backends
from synth.render.backends import BACKENDS, choose_backend, has_backend

SCRIPT = Path(__file__).with_name("render_one.py")
PRESENT = [backend for backend in BACKENDS if has_backend(backend)]

spec = importlib.util.spec_from_file_location("render_one", SCRIPT)
render_one = importlib.util.module_from_spec(spec)
spec.loader.exec_module(render_one)


@cache
def rendered(backend: str, kind: str) -> dict[str, np.ndarray]:
    with TemporaryDirectory() as folder:
        out = Path(folder) / "view.npz"
        subprocess.run([sys.executable, SCRIPT, backend, kind, out], check=True)
        with np.load(out) as arrays:
            return dict(arrays)


def exact_ball_view():
    """Depth and label by the quadratic of a ray and a sphere, and of a ray and the plane z = 0."""
    scene = render_one.ball_scene()
    camera, pose = scene.camera, scene.poses[0]
    u, v = np.meshgrid(np.arange(camera.width), np.arange(camera.height))
    rays = np.stack(
        [(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, np.ones(u.shape)], -1
    )
    directions = rays @ pose.world_to_camera
    origin = pose.position_m()
    plane_m = np.where(directions[..., 2] < 0, -origin[2] / directions[..., 2], np.nan)
    arm = origin - render_one.BALL_CENTRE_M
    square = (directions**2).sum(-1)
    half = directions @ arm
    root = half**2 - square * (arm @ arm - render_one.BALL_RADIUS_M**2)
    ball_m = np.where(root > 0, (-half - np.sqrt(np.maximum(root, 0))) / square, np.nan)
    # The ball's angle to the ray: 1 head on, 0 at the limb.
    facing = np.sqrt(np.maximum(root, 0) / square) / render_one.BALL_RADIUS_M
    return plane_m, ball_m, facing


@pytest.mark.parametrize("backend", PRESENT)
def test_depth_is_the_closed_form_of_ball_and_plane(backend):
    view = rendered(backend, "ball")
    plane_m, ball_m, facing = exact_ball_view()
    hit = ~np.isnan(ball_m)
    # The facets of the ball leave its limb up to 0.1 mm inside: pixels whose label differs are a
    # thin part of the limb, some 400 pixels long.
    assert (hit != (view["labels"] == 1)).sum() <= 8
    inner = hit & (facing > 0.3)
    # Facets of 2.5 % of the radius lie at most 0.2 mm under the surface, seen at 0.3 as 0.6 mm;
    # half a pixel's slip of cx or cy would cost 5 mm on the ground.
    assert np.abs(view["depth_m"] - ball_m)[inner].max() < 6e-4
    ground = (view["labels"] == 0) & ~maximum_filter(hit, 3)
    # float32 at 4 m steps by 0.5 µm; the depth buffer's step is of the same size.
    assert np.abs(view["depth_m"] - plane_m)[ground].max() < 5e-5


@pytest.mark.parametrize("pair", list(combinations(PRESENT, 2)), ids="-".join)
def test_backends_agree(pair):
    one, two = (rendered(backend, "yard") for backend in pair)
    assert (np.isnan(one["depth_m"]) == np.isnan(two["depth_m"])).all()
    apart = np.abs(one["depth_m"] - two["depth_m"]) > 1e-3
    assert apart.mean() <= 5e-4
    # A sample within rounding of an edge may fall on either side of it.
    assert (one["labels"] != two["labels"]).mean() <= 5e-5
    assert (one["silhouettes"] != two["silhouettes"]).mean() <= 5e-5
    # One code paints both, from the depth and labels that differ as above; a texture stretched
    # over 1 mm less of depth moves by a few grey levels, an edge by more.
    levels = np.abs(one["image"].astype(int) - two["image"])
    assert (levels > 4).mean() <= 5e-4


@pytest.mark.parametrize("backend", PRESENT)
def test_silhouettes_hold_what_is_seen_and_more(backend):
    view = rendered(backend, "pair")
    for index, silhouette in enumerate(view["silhouettes"]):
        # The same mesh is sampled at the same points with and without its neighbour.
        assert not ((view["labels"] == index + 1) & ~silhouette).any()
    front, back = view["silhouettes"]
    np.testing.assert_array_equal(front, view["labels"] == 1)
    np.testing.assert_array_equal(back & ~front, view["labels"] == 2)
    # The balls overlap in the image by a good part of the one behind, some 5,000 pixels.
    assert (back & front).sum() > 500


def test_at_least_one_backend_is_here():
    assert PRESENT


def test_auto_takes_the_first_present():
    assert choose_backend("auto") == PRESENT[0]


def test_missing_backend_names_the_package(monkeypatch):
    monkeypatch.setattr(backends, "has_backend", lambda name: name == "embree")
    with pytest.raises(MissingBackendError, match="libosmesa6"):
        choose_backend("osmesa")
    with pytest.raises(MissingBackendError, match="libegl1"):
        choose_backend("egl")
    assert choose_backend("auto") == "embree"
    monkeypatch.setattr(backends, "has_backend", lambda _: False)
    with pytest.raises(MissingBackendError, match="libosmesa6") as caught:
        choose_backend("auto")
    assert caught.value.exit_status == 3


CONTEXTS = """
import sys
from synth.light import light_scene
from synth.render import open_renderer, render_view
from synth.scene.scene import build_scene
from synth.spec import convert_spec
table = {"rocks": {"count": 2, "family": "rounded-box"}, "camera": {"preset": "imp"}}
spec = convert_spec(table, where="test")
scene = build_scene(spec, 0)
stage = light_scene(scene, spec.sun, spec.surface)
renderer = open_renderer(sys.argv[1], stage, scene.camera)
from OpenGL import contextdata
for pose in scene.poses:
    render_view(renderer, stage, scene.camera, pose, supersample=1)
    print(sum(len(storage) for storage in contextdata.STORAGES))
"""


@pytest.mark.parametrize("backend", [backend for backend in PRESENT if backend != "embree"])
def test_nothing_is_held_of_contexts_that_are_gone(backend):
    command = [sys.executable, "-c", CONTEXTS, backend]
    found = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    assert found == ["0"] * 4
