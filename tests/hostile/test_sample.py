"""Sample of the corpus and of the fuzzers; `make hostile` and `make fuzz` run the whole."""

import contextlib
import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings

import rockshape
from rockshape.cli import main
from rockshape.errors import InputError
from rockshape.io import read_image, read_range
from rockshape.io.guard import guard
from tests.hostile import fuzz, kill, scene, soak
from tests.hostile.cases import SHARES, SIZE, cases
from tests.hostile.disturbances import WAYS, can_mount
from tests.hostile.judge import Bench
from tests.hostile.seeds import readable_formats, seeds, seeds_of

SAMPLE = 24


@pytest.fixture
def bench():
    here = Path.cwd()
    found = Bench()
    yield found
    os.chdir(here)
    found.close()


def test_the_corpus_is_the_same_each_time_and_covers_every_format_and_command() -> None:
    whole = list(cases())
    assert len(whole) >= 1500
    assert whole[::50] == list(cases())[::50]
    assert sum(SHARES.values()) == pytest.approx(1)
    assert {case.command for case in whole} == {
        "measure", "synth scene", "synth shapes", "validate run", "validate compare", "formats",
    }  # fmt: skip
    names = {case.name for case in whole}
    for one in readable_formats():
        assert {f"{one.name} damaged", f"{one.name} odd"} <= names
    assert len(whole) == SIZE


def test_every_format_has_seeds_of_its_own_which_are_read(tmp_path) -> None:
    for index, seed in enumerate(seeds()):
        path = tmp_path / str(index) / f"hostile{seed.suffix}"
        path.parent.mkdir()
        path.write_bytes(seed.data)
        options = {"view": "1"} if seed.format == "COLMAP" else {}
        options |= {"view": "3"} if seed.format == "BOP scene_camera" else {}
        found = fuzz.READERS[seed.kind](path, **options)
        assert seed.kind != "labels" or len(found) >= 1
    for one in readable_formats():
        assert {seed.format for seed in seeds_of(one)} == {one.name}


def test_a_sample_of_the_corpus_is_read_or_refused_in_one_line(bench) -> None:
    chosen = [case for case in cases(count=400) if case.kind not in ("run", "option")]
    for case in chosen[:: len(chosen) // SAMPLE]:
        verdict = bench.judge(case)
        assert verdict.outcome in ("done", "refused"), (case, verdict)


@pytest.mark.parametrize("name", fuzz.FUZZERS)
def test_the_fuzzers_find_nothing_in_a_few_examples(name) -> None:
    function, drawn = fuzz.FUZZERS[name]
    few = settings(max_examples=25, deadline=None, derandomize=True)
    few(given(*drawn)(fuzz.fresh(function)))()


def test_what_takes_too_long_is_told_though_its_alarm_is_swallowed(monkeypatch) -> None:
    monkeypatch.setattr(fuzz, "LIMIT_S", 0.05)
    monkeypatch.setattr(fuzz, "TICK_S", 0.01)
    fuzz.COUNTS.clear()
    swallowed = 0
    with (
        pytest.raises(AssertionError, match=r"expected an end within 0\.05 s"),
        fuzz.limited("loop"),
    ):
        while swallowed < 3:
            with contextlib.suppress(TimeoutError):
                while True:
                    pass
            swallowed += 1
    late = pytest.raises(AssertionError, match="expected an end")
    with late, fuzz.limited("loop"), guard(InputError):
        while True:
            pass
    assert fuzz.COUNTS["loop", "late"] == 2


@pytest.fixture(scope="module")
def given_files(tmp_path_factory) -> Path:
    """Inputs of the commands that are disturbed."""
    return kill.inputs(tmp_path_factory.mktemp("given"))


@pytest.fixture(scope="module", params=kill.COMMANDS)
def calm_run(request, given_files, tmp_path_factory) -> tuple[str, kill.Calm]:
    """A command and what its undisturbed run writes."""
    folder = tmp_path_factory.mktemp("calm")
    return request.param, kill.undisturbed(request.param, folder=folder, given=given_files)


@pytest.mark.parametrize("told", WAYS)
def test_a_disturbed_run_is_resumed_to_the_undisturbed_bytes(
    told, calm_run, given_files, tmp_path
) -> None:
    if told == "full disks" and not can_mount(tmp_path):
        pytest.skip("no filesystem can be mounted here")
    name, calm = calm_run
    place = {"folder": tmp_path, "given": given_files}
    found = kill.disturbed(name, WAYS[told], calm, times=1, seed=3, **place)
    assert list(found) == []


def test_frames_leave_nothing_behind() -> None:
    before, after = soak.soak(30)
    assert after.resident_bytes - before.resident_bytes <= soak.MAX_GROWTH_BYTES
    assert (after.threads, after.handles) == (before.threads, before.handles)


@pytest.mark.parametrize("depth_m", [5e-315, 1e-60, 1e-7])
def test_points_at_the_cameras_very_plane_are_none(depth_m, tmp_path) -> None:
    points_m = scene.points_m()
    points_m[20:26, 30:40] = (0.6, 0.1, depth_m)
    np.save(tmp_path / "xyz.npy", points_m)
    camera = rockshape.Camera(**scene.CAMERA)
    found = read_range(tmp_path / "xyz.npy", shape=scene.SHAPE, camera=camera)
    spoilt = np.isnan(found[..., 2])
    assert spoilt[20:26, 30:40].all()
    assert np.count_nonzero(spoilt) == 60
    rockshape.measure(scene.image(), range_m=found, camera=camera, labels=scene.labels())


@pytest.mark.parametrize("name", ["/dev/zero", "/dev/null", "/"])
@pytest.mark.parametrize(
    "argv",
    [
        ("synth", "scene", "--spec", "{}", "out"),
        ("synth", "scene", "--replay", "{}", "out"),
        ("validate", "run", "--gates", "{}", "--out", "out"),
    ],
)
def test_what_is_no_regular_file_is_refused(name, argv, tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    assert main([word.replace("{}", name) for word in argv]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_lone_surrogate_in_a_manifest_is_refused(tmp_path, capsys) -> None:
    manifest = tmp_path / "manifest.json"
    manifest.write_text(
        '{"spec": {"renderer": "\\ud800"}, "backend": "embree", "files": {}}', encoding="utf-8"
    )
    assert main(["synth", "scene", "--replay", str(manifest), str(tmp_path / "out")]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_picture_without_pixels_is_refused(tmp_path, monkeypatch) -> None:
    from rockshape.io import registry
    from rockshape.io.format import ImageFormat

    empty = ImageFormat(
        name="empty", suffixes=(".empty",), summary="none", read=lambda _: np.zeros(0, np.uint8)
    )
    monkeypatch.setitem(registry.IMAGES.registered, "empty", empty)
    (tmp_path / "a.empty").write_bytes(b"x")
    with pytest.raises(InputError, match=r"found pixels of the shape \(0,\)"):
        read_image(tmp_path / "a.empty")


@pytest.mark.parametrize("near_m", [8e-320, 1e-60, 1e-10])
def test_a_z_depth_of_nothing_is_none(near_m, tmp_path) -> None:
    depth_m = scene.depth_m()
    depth_m[20:35, 30:60] = near_m
    np.save(tmp_path / "depth.npy", depth_m)
    camera = rockshape.Camera(**scene.CAMERA)
    found = read_range(tmp_path / "depth.npy", shape=scene.SHAPE, camera=camera)
    assert np.isnan(found[20:35, 30:60]).all()
    assert np.count_nonzero(np.isnan(found[..., 2])) == 15 * 30
    rockshape.measure(scene.image(), range_m=found, camera=camera, labels=scene.labels())


def test_an_output_folder_whose_name_is_no_utf_8_is_refused(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["validate", "run", "--out", "\udcff"]) == 2
    assert "UTF-8" in capsys.readouterr().err


def test_signalling_nan_says_nothing(tmp_path) -> None:
    steps = scene.points_m().astype("<f4")
    steps.view("<u4")[3, 4] = 0x7F800001  # IEEE 754: quiet bit clear
    np.save(tmp_path / "xyz.npy", steps)
    camera = rockshape.Camera(**scene.CAMERA)
    found = read_range(tmp_path / "xyz.npy", shape=scene.SHAPE, camera=camera)
    assert np.argwhere(np.isnan(found[..., 0])).tolist() == [[3, 4]]


def test_an_output_folder_may_be_named_as_a_uri_is(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    kill.inputs(tmp_path)
    assert main(["validate", "run", "--suite", "suite.toml", "--jobs", "1", "--out", "a:b"]) == 0
    assert main(["validate", "compare", "a:b", "a:b"]) == 0
