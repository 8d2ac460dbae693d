"""The public handles: scenes rendered in workers, equal to the dataset, from any kind of caller."""

import json
import os
import subprocess
import sys
import time
from importlib.metadata import version
from pathlib import Path

import cv2
import nbformat
import numpy as np
import pandas as pd
import pytest
from nbclient import NotebookClient

import synth
from synth.dataset.generate import generate_dataset
from synth.handle.client import call_in_worker
from synth.handle.jobs import render
from synth.render import backends
from tests.synth.plugins.scanner import SCANNER

SPEC = {
    "site": "plain",
    "seed": 5,
    "rocks": {"count": 3, "diameter_m": [0.5, 0.6]},
    "camera": {"preset": "imp"},
    "views": {"count": 2},
}
LINES = (
    "import synth\n"
    "scene = synth.make_scene(site='plain', rocks=2, views=1, camera='imp', seed=2)\n"
    "view = scene.render(0, noise='stereo')\n"
    "print(view.image.shape, len(view.truth), int(view.labels.max()))\n"
)
SAID = "(256, 256) 2 2"


@pytest.fixture(scope="module")
def scene():
    return synth.make_scene(SPEC)


@pytest.fixture(scope="module")
def view(scene):
    return scene.render(1, noise="stereo")


def read(path: Path) -> np.ndarray:
    return cv2.imread(str(path), cv2.IMREAD_UNCHANGED)


@pytest.mark.parametrize("noise", ["none", "stereo", "sgm"])
def test_a_view_has_exactly_the_values_of_the_datasets_files(tmp_path, scene, noise):
    made = synth.make_scene(SPEC, noise=noise)
    generate_dataset(made.spec, tmp_path / "out")
    folder = tmp_path / "out" / "000000"
    view = scene.render(1, noise=noise)
    np.testing.assert_array_equal(view.image, read(folder / "gray" / "000001.png"))
    np.testing.assert_array_equal(view.labels, read(folder / "labels" / "000001.png"))
    scale_mm = json.loads((tmp_path / "out" / "camera.json").read_text())["depth_scale"]
    for name, depth_m in (("depth", view.depth_m), ("depth_true", view.exact_depth_m)):
        if (folder / name).is_dir():
            steps = read(folder / name / "000001.png")
            np.testing.assert_array_equal(np.isnan(depth_m), steps == 0)
            known = steps > 0
            np.testing.assert_array_equal(depth_m[known], steps[known] * (scale_mm / 1000))
    assert set(view.pictures) == ({"gray_right"} if noise == "sgm" else set())
    for name, picture in view.pictures.items():
        np.testing.assert_array_equal(picture, read(folder / name / "000001.png"))
    told = json.loads((folder / "scene_gt_shape.json").read_text())
    for row, rock, seen in zip(
        view.truth.itertuples(), told["rocks"], told["views"]["1"], strict=True
    ):
        assert row.id == rock["instance"] + 1
        axes = (row.half_axis_a_m, row.half_axis_b_m, row.half_axis_c_m)
        assert list(axes) == rock["half_axes_box_m"]
        for name in ("roundness", "maximum_projection_sphericity", "wadell_sphericity"):
            assert getattr(row, name) == rock[name]
        for name in ("visible_fraction", "truncated", "outline_axis_ratio", "outline_roundness"):
            assert getattr(row, name) == seen[name]


def test_write_makes_the_same_dataset_as_generating(tmp_path, scene):
    scene.write(tmp_path / "one")
    generate_dataset(scene.spec, tmp_path / "two")
    one, two = ((tmp_path / name / "manifest.json").read_text() for name in ("one", "two"))
    assert one == two  # it holds every file's SHA-256


def test_labels_of_a_view_are_the_ids_of_its_truth(view, scene):
    assert list(view.truth["id"]) == [1, 2, 3]
    assert set(np.unique(view.labels)) == {0, 1, 2, 3}
    assert list(scene.truth["id"]) == [1, 2, 3]
    shared = scene.truth.columns
    pd.testing.assert_frame_equal(scene.truth, view.truth[shared])


def test_rendering_leaves_no_opengl_and_no_process_in_the_caller():
    # A process that has OpenGL, or forks from one that has, could not render any more.
    script = (
        LINES + "import os, sys\n"
        "assert 'OpenGL' not in sys.modules\n"
        "try:\n"
        "    print(os.waitpid(-1, os.WNOHANG))\n"
        "except ChildProcessError:\n"
        "    print('no child')\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout.splitlines()) == (0, [SAID, "no child"]), done.stderr


@pytest.mark.parametrize("how", ["script", "command", "stdin"])
def test_it_works_without_a_guard(tmp_path, how):
    (tmp_path / "script.py").write_text(LINES)
    command = {"script": ["script.py"], "command": ["-c", LINES], "stdin": ["-"]}[how]
    done = subprocess.run(
        [sys.executable, *command],
        input=LINES if how == "stdin" else None,
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout.strip(), done.stderr) == (0, SAID, "")


def test_it_works_from_a_notebook(tmp_path):
    code = [LINES, "view", "synth.make_shapes('sphericity', count=3, seed=1)"]
    cells = [nbformat.v4.new_code_cell(each) for each in code]
    notebook = nbformat.v4.new_notebook(cells=cells)
    NotebookClient(notebook, timeout=300, resources={"metadata": {"path": tmp_path}}).execute()
    printed, shown, drawn = (cell["outputs"][0] for cell in notebook.cells)
    assert printed["text"].strip() == SAID
    assert shown["data"]["text/html"].count("<img src=") == 2
    assert "<td>rounded-polyhedron</td>" in shown["data"]["text/html"]
    assert drawn["data"]["text/plain"] == "DrawnShapes('sphericity': 3 shapes, 260 × 780 px)"


def test_a_module_of_the_callers_folder_does_not_shadow_the_workers(tmp_path):
    (tmp_path / "random.py").write_text("raise SystemExit('shadowed')\n")
    env = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        [sys.executable, "-P", "-c", LINES],
        cwd=tmp_path,
        env=env,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout.strip()) == (0, SAID), done.stderr


def test_a_registered_sensor_is_known_to_the_worker(scene):
    synth.register_sensor(SCANNER)
    view = scene.render(0, noise={"kind": "scanner", "options": {"rows_apart": 16}})
    assert np.isnan(view.depth_m[1:16]).all()
    assert np.isfinite(view.depth_m[::16]).any()
    assert view.pictures["intensity"].shape == view.image.shape


def test_a_worker_that_takes_too_long_is_ended():
    start = time.monotonic()
    with pytest.raises(synth.RenderError, match=r"timeout_s: expected .* within 0.5 s"):
        call_in_worker(time.sleep, 60, timeout_s=0.5)
    assert time.monotonic() - start < 30


def test_a_worker_that_dies_is_told_with_its_status():
    with pytest.raises(synth.RenderError, match="found exit status 7"):
        call_in_worker(os._exit, 7, timeout_s=60)


def test_a_defect_in_a_worker_keeps_its_traceback():
    with pytest.raises(synth.RenderError, match="ZeroDivisionError"):
        call_in_worker(divmod, 1, 0, timeout_s=60)


def test_what_libraries_print_is_no_part_of_the_reply():
    assert call_in_worker(print, "noise", timeout_s=60) is None


def render_without_backends(spec, model):
    """Render as on a machine that has no renderer."""
    backends.has_backend = lambda _: False
    return render(spec, 0, 0, model)


def test_a_missing_renderer_passes_through(scene):
    model = scene._built.model
    with pytest.raises(synth.MissingBackendError, match="libosmesa6") as caught:
        call_in_worker(render_without_backends, scene.spec, model, timeout_s=120)
    assert caught.value.exit_status == 3


@pytest.mark.parametrize(
    ("source", "options", "words"),
    [
        (None, {"rockz": 3}, "make_scene: unknown argument 'rockz'; did you mean 'rocks'?"),
        (None, {"rocks": -1}, "rocks.count: expected an integer from 0 to 500, found -1"),
        (None, {"camera": "msl-navcm"}, "did you mean 'msl-navcam'?"),
        (None, {"noise": "sterio"}, "noise.kind: expected one of none, stereo, sgm"),
        (None, {"sun": {"elevation": 3}}, "unknown key 'elevation' in [sun]; did you mean 'elev"),
        ({"rocks": {"cuont": 3}}, {}, "unknown key 'cuont' in [rocks]; did you mean 'count'?"),
        (3, {}, "spec: expected a path to a TOML file, a SceneSpec or a table, found int"),
        ("absent.toml", {}, "absent.toml: expected a TOML file"),
    ],
)
def test_a_mistake_names_the_argument(source, options, words):
    with pytest.raises(synth.SpecError) as caught:
        synth.make_scene(source, **options)
    assert words in str(caught.value)


def test_views_and_indices_that_do_not_exist(scene):
    with pytest.raises(synth.SpecError, match="view: expected 0 to 1, found 2"):
        scene.render(2)
    for view in (1.0, "a", None):
        with pytest.raises(synth.SpecError, match="view: expected a whole number, found"):
            scene.render(view)
    with pytest.raises(synth.SpecError, match="index: expected 0 to 0, found 1"):
        synth.make_scene(index=1)
    with pytest.raises(synth.SpecError, match=r"render: noise\.kind: .* did you mean 'stereo'"):
        scene.render(0, noise="sterio")


def test_numbers_of_numpy_are_numbers():
    ours = synth.make_scene(
        rocks=np.int64(3), seed=np.uint8(2), sun={"elevation_deg": np.float32(20)}
    )
    assert ours.spec == synth.make_scene(rocks=3, seed=2, sun={"elevation_deg": 20.0}).spec
    ratios = synth.make_scene(rocks={"b_over_a": np.array([0.5, 1.0])}).spec.rocks.b_over_a
    assert ratios == (0.5, 1.0)


def test_rocks_that_do_not_fit_are_the_callers_error():
    crowd = synth.make_scene(site="plain", rocks=60, camera="msl-navcam")
    with pytest.raises(synth.SpecError, match=r"rocks\.count"):
        crowd.render(0)


def test_sources_of_a_specification_agree(tmp_path):
    path = tmp_path / "spec.toml"
    path.write_text('seed = 4\n[rocks]\ncount = 4\nfamily = "ellipsoid"\nseries = "random"\n')
    from_file = synth.make_scene(path, noise="sgm")
    by_options = synth.make_scene(
        seed=4, rocks=4, family="ellipsoid", series="random", noise={"kind": "sgm"}
    )
    from_table = synth.make_scene(
        {"seed": 4, "rocks": {"count": 4, "family": "ellipsoid", "series": "random"}},
        noise="sgm",
    )
    assert from_file.spec == by_options.spec == from_table.spec
    assert synth.make_scene(from_file.spec).spec == from_file.spec
    assert synth.make_scene(str(path), rocks={"count": 5}).spec.rocks.family == "ellipsoid"


def test_reprs_are_short(scene, view):
    assert repr(scene) == "Scene(3 rocks, 2 views, camera 'imp', noise 'none', seed 5)"
    assert repr(view).startswith("View(1: 256 × 256 px, 3 rocks in sight, depth ")
    html = view._repr_html_()
    assert html.count("<img") == 2
    assert len(html) < 300_000


def test_a_views_figure_shows_image_and_depth(view, tmp_path):
    figure = view.plot()
    figure.savefig(tmp_path / "view.png")
    assert [axes.get_title() for axes in figure.axes[:2]] == ["3 rocks", "depth, stereo"]


def test_shapes_are_those_that_are_written(tmp_path):
    shapes = synth.make_shapes("both", count=3, seed=6)
    shapes.write(tmp_path / "out")
    np.testing.assert_array_equal(shapes.image, read(tmp_path / "out" / "image.png"))
    np.testing.assert_array_equal(shapes.labels, read(tmp_path / "out" / "labels.png"))
    table = pd.read_csv(tmp_path / "out" / "truth.csv").rename(columns={"rock": "id"})
    pd.testing.assert_frame_equal(  # the file has ten digits, and 60 for 60.0
        shapes.truth, table, rtol=1e-9, check_dtype=False
    )
    with pytest.raises(synth.SpecError, match=r"series: .* did you mean 'roundness'"):
        synth.make_shapes("rondness")


def test_the_public_names_are_there_and_the_import_is_light():
    assert synth.__version__ == version("rockshape")
    assert all(getattr(synth, name) is not None for name in synth.__all__)
    script = "import sys, synth\nprint(*{'numpy', 'cv2', 'scipy', 'msgspec'} & set(sys.modules))"
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == ""
