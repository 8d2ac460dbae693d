"""Things that are no rocks: their size in pixels, their masks, and frames without any rock."""

import json

import cv2
import numpy as np
import pytest
from pycocotools.coco import COCO

import synth
from synth.camera.projection import project
from synth.light.mast import MastShadow
from synth.light.thing_body import thing_body
from synth.rocks.ellipsoid import ellipsoid
from synth.scene.ground import make_ground
from synth.scene.thing_placement import place_things
from synth.spec.ground import GroundSpec
from synth.spec.things import ThingsSpec
from synth.things.record import CLASSES

COMMON = {
    "site": "plain",
    "camera": {"preset": "imp", "distance_m": 4},
    "views": 1,
    "seed": 3,
    "renderer": "embree",
}


@pytest.fixture(scope="module")
def views():
    """Return one scene without things, and with them."""
    bare = synth.make_scene(rocks=2, **COMMON).render(0)
    scene = synth.make_scene(
        rocks=2,
        things={"kinds": ["ruler", "ball"], "ruler_m": 0.2},
        image={"colour": True},
        **COMMON,
    )
    return bare, scene.render(0), scene


def test_rocks_keep_their_labels_and_things_have_their_own(views):
    bare, view, _ = views
    thing = view.not_rock > 0
    assert set(np.unique(view.not_rock)) == {0, CLASSES["ruler"], CLASSES["ball"]}
    np.testing.assert_array_equal(view.labels[~thing], bare.labels[~thing])
    assert not view.labels[thing].any()
    assert not bare.not_rock.any()
    assert list(view.truth["id"]) == list(bare.truth["id"])
    assert (view.depth_m[thing] < bare.depth_m[thing]).all()


def test_a_ruler_is_as_long_in_pixels_as_its_projection(views, tmp_path):
    _, view, scene = views
    scene.write(tmp_path / "out")
    folder = tmp_path / "out" / "000000"
    ruler = json.loads((folder / "scene_things.json").read_text())["things"][0]
    turn = np.reshape(ruler["rotation_model_to_world"], (3, 3))
    assert ruler["size_m"][0] == pytest.approx(0.2)
    half = np.array([[x * 0.1, y * 0.015, 0.006] for x in (-1, 1) for y in (-1, 1)])
    corners = project(view.camera, view.pose.camera_points_m(half @ turn.T + ruler["position_m"]))
    mask = cv2.imread(str(folder / "not_rock" / "000000.png"), cv2.IMREAD_UNCHANGED)
    np.testing.assert_array_equal(mask, view.not_rock)
    rows, columns = np.nonzero(mask == CLASSES["ruler"])
    along = corners[2:].mean(axis=0) - corners[:2].mean(axis=0)
    length_px = float(np.linalg.norm(along))
    assert length_px > 20.0
    places = np.column_stack([columns, rows]) @ (along / length_px)
    assert np.ptp(places) + 1.0 == pytest.approx(np.ptp(corners @ along / length_px), abs=1.5)
    assert (folder / "rgb" / "000000.png").is_file()


def test_a_rulers_stripes_are_the_mean_over_the_pixel():
    ground = make_ground(GroundSpec(), radius_m=3.0, rng=np.random.default_rng(1))
    rng = np.random.default_rng(2)
    (ruler,) = place_things(ThingsSpec(), ground, [], reach_m=1.0, rng=rng)
    paint = thing_body(ruler).paint
    x = np.array([0.002, 0.012, 0.0201], dtype=np.float32)
    points = np.column_stack([x, 0 * x, 0 * x])
    fine = paint(points, np.full(3, 1e-4, dtype=np.float32))[:, 0]
    np.testing.assert_allclose(fine, [1.0, 0.06, 1.0], atol=2e-3)
    np.testing.assert_allclose(paint(points, np.full(3, 0.02, dtype=np.float32)), 0.53, atol=1e-5)


def test_things_lie_apart_from_rocks_on_the_ground():
    ground = make_ground(GroundSpec(slope_deg=8.0), radius_m=3.0, rng=np.random.default_rng(1))
    kinds = ("ruler", "cable", "wheel", "deck", "coin", "ball")
    rock = ellipsoid(np.full(3, 0.2)).mesh
    rng = np.random.default_rng(2)
    things = place_things(ThingsSpec(kinds=kinds), ground, [rock], reach_m=1.5, rng=rng)
    assert [thing.model.kind for thing in things] == list(kinds)
    for thing in things:
        points = thing.mesh.vertices_m
        assert np.linalg.norm(points[:, :2], axis=1).min() > 0.2
        clearance = points[:, 2] - ground.heights_m(points[:, :2])
        assert abs(clearance.min()) < 0.003, thing.model.kind
    with pytest.raises(synth.SpecError, match=r"things.kinds: expected room for a deck"):
        place_things(ThingsSpec(kinds=("deck",)), ground, [rock], reach_m=0.1, rng=rng)


def test_the_masts_shadow_falls_where_the_suns_ray_passes_the_mast():
    eye = np.array([3.0, 0.0, 2.0])
    shadow = MastShadow([eye])
    towards = np.array([np.cos(np.deg2rad(40.0)), 0.0, np.sin(np.deg2rad(40.0))], np.float32)
    head_m = 3.0 - 2.0 / np.tan(np.deg2rad(40.0))  # the eye's own shadow on level ground
    places = np.array([[head_m, 0.2, 0.0], [head_m, 0.24, 0.0], [2.0, 0.04, 0.0], [2.0, 0.08, 0.0]])
    found = shadow.blocked(places.astype(np.float32), eye.astype(np.float32), towards)
    assert found.tolist() == [True, False, True, False]


def test_a_frame_without_a_rock_is_a_dataset_like_any_other(tmp_path):
    table = {"dataset": {"split": 0.5, "yolo": True}, "scenes": 2, "things": {"kinds": ["coin"]}}
    scene = synth.make_scene(table, rocks=0, **COMMON)
    view = scene.render(0)
    assert not view.labels.any()
    assert len(view.truth) == 0
    assert list(view.truth["id"]) == []
    assert len(scene.truth) == 0
    scene.write(tmp_path / "out")
    assert json.loads((tmp_path / "out" / "000000" / "scene_gt.json").read_text()) == {"0": []}
    for name in ("000000/scene_gt_coco.json", "coco/train.json"):
        coco = COCO(str(tmp_path / "out" / name))
        assert len(coco.getImgIds()) == 1
        assert coco.getAnnIds() == []
    labels = tmp_path / "out" / "yolo" / "labels" / "train" / "000000_000000.txt"
    assert labels.read_text() == ""
