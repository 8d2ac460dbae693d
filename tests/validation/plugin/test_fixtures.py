"""Fixtures that render: what a view holds, that it is kept, and what is refused."""

import pytest

pytest_plugins = ["pytester"]

SPEC = """
SPEC = {
    "site": "plain",
    "seed": 3,
    "renderer": "embree",
    "rocks": {"count": 2, "family": "rounded-box"},
    "camera": {"preset": "imp", "supersample": 1},
    "views": {"count": 2},
}
"""
VIEWS = (
    SPEC
    + """
import numpy as np
import pytest
from validation.testing import assert_consistent

def test_a_view_is_image_depth_labels_camera_and_truth(rockshape_view):
    view = rockshape_view(SPEC)
    rows, cols = view.image.shape
    assert view.depth_m.shape == view.labels.shape == (rows, cols)
    assert (view.camera.width, view.camera.height) == (cols, rows)
    assert sorted(np.unique(view.labels)) == [0, 1, 2] and list(view.truth["id"]) == [1, 2]
    assert np.isfinite(view.depth_m[view.labels > 0]).all()
    view.labels[:] = 0
    assert rockshape_view(SPEC).labels.any(), "another call sees other arrays"

def test_a_scene_is_built_once_and_gives_the_same_views(rockshape_scene, rockshape_view):
    scene = rockshape_scene(SPEC)
    assert rockshape_scene(SPEC) is scene is not rockshape_scene(SPEC, seed=4)
    one, other = rockshape_view(scene, 1), rockshape_view(SPEC, view=1)
    assert one.number == other.number == 1
    np.testing.assert_array_equal(one.image, other.image)
    assert not np.array_equal(one.image, rockshape_view(scene, 0).image)

def test_noise_names_the_sensor(rockshape_view):
    assert rockshape_view(SPEC, noise="stereo").noise == "stereo"

def test_areas_hold_between_views(rockshape_view):
    views = [rockshape_view(SPEC, view=number) for number in range(2)]
    areas = [{rock: (view.labels == rock).sum() for rock in (1, 2)} for view in views]
    assert_consistent(areas, cv_at_most=0.5)

def test_what_is_refused(rockshape_scene, rockshape_view):
    with pytest.raises(ValueError, match="rocs.*rocks"):
        rockshape_scene(rocs=1)
    with pytest.raises(ValueError, match="noise alone beside a scene, found seed"):
        rockshape_view(rockshape_scene(SPEC), seed=1)
    with pytest.raises(ValueError, match="view: expected 0 to 1, found 2"):
        rockshape_view(SPEC, view=2)
"""
)
COUNTED = (
    SPEC
    + """
import pytest, synth

@pytest.fixture(autouse=True)
def no_rendering(monkeypatch):
    monkeypatch.setattr(synth.Scene, "render", None)

def test_view(rockshape_view):
    assert rockshape_view(SPEC).labels.any()
"""
)


def test_views_and_scenes_and_that_views_are_kept(pytester) -> None:
    pytester.makepyfile(test_views=VIEWS)
    pytester.runpytest_inprocess("-W", "error").assert_outcomes(passed=5)
    kept = sorted(pytester.path.glob(".pytest_cache/d/rockshape/views/*.view"))
    assert len(kept) == 3  # views 0 and 1, and 0 through the stereo sensor
    pytester.makepyfile(test_again=COUNTED)
    pytester.runpytest_inprocess("test_again.py").assert_outcomes(passed=1)
    pytester.runpytest_inprocess("test_again.py", "--rockshape-no-cache").assert_outcomes(failed=1)
    pytester.runpytest_inprocess("test_again.py", "--cache-clear").assert_outcomes(failed=1)


def test_fixtures_are_listed_with_what_they_give(pytester) -> None:
    result = pytester.runpytest_inprocess("--fixtures")
    result.stdout.fnmatch_lines(
        [
            "rockshape_scene *session scope*",
            "*Factory of scenes*",
            "rockshape_view *",
            "*rendered views*",
        ]
    )


@pytest.mark.parametrize("words", [(), ("-p", "no:cacheprovider")])
def test_without_a_cache_nothing_is_left(pytester, words, monkeypatch, tmp_path) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    pytester.makepyfile(
        "def test_scene(rockshape_scene):\n    rockshape_scene(site='plain', seed=1)\n"
    )
    pytester.runpytest_inprocess("--rockshape-no-cache", *words).assert_outcomes(passed=1)
    assert list(tmp_path.glob("rockshape-pytest-*")) == []
