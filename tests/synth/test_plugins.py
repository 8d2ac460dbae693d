"""A sensor and a rock family from outside, each one file: registered, by module, by entry point."""

import json
import os
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

from rockshape.cli import main
from synth.dataset.generate import generate_dataset
from synth.errors import SpecError
from synth.rocks import Family, quarry, register_family
from synth.sensor import Capture, Sensor, SensorInput, register_sensor
from synth.spec import convert_spec
from synth.spec.rocks import RocksSpec
from tests.synth.plugins.bricks import BRICK
from tests.synth.plugins.scanner import SCANNER

SCANNER_SCENE = {
    "seed": 3,
    "rocks": {"count": 2},
    "camera": {"preset": "imp"},
    "views": {"count": 1},
    "noise": {"kind": "scanner", "options": {"rows_apart": 8, "sd_m": 0.002}},
}


@pytest.fixture(autouse=True)
def registered(no_registered_records):  # noqa: ARG001 (runs before)
    """Both records."""
    register_sensor(SCANNER)
    register_family(BRICK)


def read(path: Path) -> np.ndarray:
    return cv2.imread(str(path), cv2.IMREAD_UNCHANGED)


def check_scanner_dataset(out: Path, *, rows_apart: int, sd_m: float) -> None:
    """The dataset's depth is the exact one at scanned rows, but for the sensor's noise."""
    scale_m = json.loads((out / "camera.json").read_text())["depth_scale"] / 1000
    depth, exact, intensity, gray = (
        read(out / "000000" / name / "000000.png")
        for name in ("depth", "depth_true", "intensity", "gray")
    )
    scanned = np.arange(len(depth)) % rows_apart == 0
    assert (depth[~scanned] == 0).all()
    measured = (depth > 0) & (exact > 0)
    assert measured[scanned].mean() > 0.5
    errors_m = scale_m * (depth[measured].astype(float) - exact[measured])
    # Normal errors of some thousand points: mean within 4 σ/√n, deviation within 10 %.
    assert abs(errors_m.mean()) < 4 * sd_m / np.sqrt(errors_m.size)
    assert errors_m.std() == pytest.approx(sd_m, rel=0.1)
    np.testing.assert_array_equal(intensity[measured], gray[measured])
    assert not (out / "000000" / "gray_right").exists()


def test_a_registered_sensor_makes_a_dataset(tmp_path):
    spec = convert_spec(SCANNER_SCENE, where="test")
    generate_dataset(spec, tmp_path / "out")
    check_scanner_dataset(tmp_path / "out", rows_apart=8, sd_m=0.002)
    manifest = json.loads((tmp_path / "out" / "manifest.json").read_text())
    assert convert_spec(manifest["spec"], where="manifest") == spec


def test_a_registered_family_is_drawn_with_its_options(tmp_path):
    table = {
        "rocks": {"count": 2, "family": "brick", "series": "random", "options": {"flatness": 0.5}},
        "camera": {"preset": "imp"},
        "views": {"count": 1},
    }
    generate_dataset(convert_spec(table, where="test"), tmp_path / "out")
    rocks = json.loads((tmp_path / "out" / "000000" / "scene_gt_shape.json").read_text())["rocks"]
    assert [rock["family"] for rock in rocks] == ["brick", "brick"]
    for rock in rocks:
        a, b, c = rock["half_axes_box_m"]
        assert rock["volume_m3"] == pytest.approx(8 * a * b * c)
        assert c / b < 0.5 * 0.88 + 1e-9  # half of what [rocks] c_over_b draws at most


def test_relief_is_laid_on_a_family_from_outside():
    spec = RocksSpec(count=1, family="brick", series="random", relief=True)
    rough = quarry(spec, rng=np.random.default_rng(1))[0]
    assert rough.truth.relief_degrees == (3, 14)
    assert rough.family == "brick"


def distribution(folder: Path) -> None:
    """Write a distribution with both modules and their entry points into a folder."""
    source = Path(__file__).parent / "plugins"
    for name in ("scanner", "bricks"):
        text = (source / f"{name}.py").read_text()
        # An installed plug-in leaves registering to its entry point.
        text = text.replace("register_sensor(", "(").replace("register_family(", "(")
        text = text.replace(", register_sensor", "").replace(", register_family", "")
        (folder / f"guest_{name}.py").write_text(text)
    info = folder / "guest-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: guest\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(
        "[synth.sensors]\nscanner = guest_scanner:SCANNER\n"
        "[synth.families]\nbrick = guest_bricks:BRICK\n"
    )


def test_entry_points_add_a_sensor_and_a_family(tmp_path):
    distribution(tmp_path)
    (tmp_path / "spec.toml").write_text(
        'site = "plain"\n[rocks]\ncount = 2\nfamily = "brick"\nseries = "random"\n'
        '[camera]\npreset = "imp"\n[views]\ncount = 1\n[noise]\nkind = "scanner"\n'
        "[noise.options]\nrows_apart = 2\n"
    )
    command = [sys.executable, "-m", "rockshape.cli", "synth", "scene", "out", "--spec"]
    done = subprocess.run(
        [*command, "spec.toml"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    check_scanner_dataset(tmp_path / "out", rows_apart=2, sd_m=0.01)
    rocks = json.loads((tmp_path / "out" / "000000" / "scene_gt_shape.json").read_text())["rocks"]
    assert {rock["family"] for rock in rocks} == {"brick"}


def test_a_module_of_the_current_folder_registers_on_the_command_line(
    tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    options = ["--site", "plain", "--rocks", "2", "--views", "1", "--camera", "imp"]
    command = ["synth", "scene", "out", *options, "--noise", "scanner"]
    assert main([*command, "--plugin", "absent_module"]) == 2
    assert "--plugin: expected a module" in capsys.readouterr().err
    assert main([*command, "--plugin", "tests.synth.plugins.scanner"]) == 0
    check_scanner_dataset(tmp_path / "out", rows_apart=4, sd_m=0.01)


@pytest.mark.parametrize(
    ("table", "words"),
    [
        (
            {"noise": {"kind": "scaner"}},
            "noise.kind: expected one of none, stereo, sgm, mesh, tof, lidar, scanner, "
            "found 'scaner'; did you mean 'scanner'?",
        ),
        (
            {"noise": {"kind": "scanner", "options": {"row_apart": 2}}},
            "noise.options: unknown key 'row_apart'; did you mean 'rows_apart'?",
        ),
        (
            {"noise": {"kind": "scanner", "options": {"sd_m": "a"}}},
            "noise.options: sd_m: expected a number, found 'a'",
        ),
        (
            {"noise": {"kind": "stereo", "options": {"sd_m": 1}}},
            "noise.options: expected none for the sensor 'stereo', found {'sd_m': 1}",
        ),
        (
            {"rocks": {"family": "brick", "series": "graded"}},
            "rocks.series: expected one of relief, random for the family 'brick', found 'graded'",
        ),
    ],
)
def test_a_misuse_is_one_line(table, words):
    with pytest.raises(SpecError) as caught:
        convert_spec(table, where="spec")
    assert str(caught.value) == f"spec: {words}"


def test_names_of_the_package_and_of_its_folders_are_taken():
    with pytest.raises(SpecError, match="'stereo': expected a new name"):
        register_sensor(Sensor("stereo", "mine", SCANNER.capture))
    with pytest.raises(SpecError, match="'mask'"):
        register_sensor(Sensor("mine", "mine", SCANNER.capture, pictures=("mask",)))
    with pytest.raises(SpecError, match="'mixed': expected a new name"):
        register_family(Family("mixed", "mine", draw=BRICK.draw))


def test_a_sensor_that_no_module_holds_is_refused_before_workers_start(tmp_path):
    def capture(shot: SensorInput) -> Capture:
        return SCANNER.capture(shot)

    register_sensor(Sensor("local", "mine", capture))
    spec = convert_spec({"noise": {"kind": "local"}}, where="test")
    with pytest.raises(SpecError, match="sensor 'local': expected one defined in a module"):
        generate_dataset(spec, tmp_path / "out")
    assert not (tmp_path / "out").exists()
