"""A method, a measure and a finder, each in one file of its own, found by entry points."""

import os
import re
import subprocess
import sys
import tomllib
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import cv2
import numpy as np
import pandas as pd
import pytest

import rockshape
import validation
from rockshape import ROBUST, Finder, Measure, Method
from rockshape.io import RangeFormat
from rockshape.pipeline import measure
from synth import Sensor
from tests.plugins.bright_method import METHOD
from tests.plugins.compactness_measure import COMPACTNESS
from tests.plugins.dark_finder import FINDER
from validation.suite.kind import Kind

ROOT = Path(__file__).parents[2]
TOML = re.compile(r"^```toml\n(.*?)^```$", flags=re.MULTILINE | re.DOTALL)
y, x = np.mgrid[:60, :90]
DISC = np.hypot(x - 40, y - 30) < 20
IMAGE = np.where(DISC, 0.9, 0.2).astype(np.float32)


def test_an_own_method_is_one_record_from_finder_to_table() -> None:
    found = rockshape.measure(IMAGE, method=METHOD)
    assert [rock.number for rock in found] == [1]
    assert found[0].area == DISC.sum()
    assert found[0].area.unit == "px²"
    assert found[0].ellipse is None
    assert found.to_frame()["area"].tolist() == [DISC.sum()]
    given = measure(found.observation, method=METHOD, labels=7 * DISC.astype(np.int32))
    assert given.to_frame()["rock"].tolist() == [7]


@pytest.fixture
def installed(tmp_path: Path) -> dict[str, str]:
    """The environment of a process in which a distribution with all plug-ins is installed."""
    info = tmp_path / "rockshape_plugins-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: rockshape-plugins\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(
        "[rockshape.methods]\nbright = tests.plugins.bright_method:METHOD\n"
        "[rockshape.measures]\ncompactness = tests.plugins.compactness_measure:COMPACTNESS\n"
        "[rockshape.finders]\ndark = tests.plugins.dark_finder:FINDER\n"
    )
    return {**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), str(ROOT)])}


def run(arguments: list[str], env: dict[str, str]) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "rockshape.cli", *arguments]
    return subprocess.run(command, env=env, capture_output=True, text=True, check=False)


def test_entry_points_add_a_method_and_a_column_to_the_command(
    tmp_path: Path, installed: dict[str, str]
) -> None:
    picture, labels, table = tmp_path / "i.png", tmp_path / "l.png", tmp_path / "t.csv"
    cv2.imwrite(str(picture), np.rint(255 * IMAGE).astype(np.uint8))
    cv2.imwrite(str(labels), DISC.astype(np.uint16))
    done = run(["measure", str(picture), "--method", "bright", "--out", str(table)], installed)
    assert done.returncode == 0, done.stderr
    assert pd.read_csv(table)["area"].tolist() == [DISC.sum()]
    done = run(["measure", str(picture), "--labels", str(labels), "--out", str(table)], installed)
    assert done.returncode == 0, done.stderr
    row = pd.read_csv(table).iloc[0]
    assert 0.98 < row["compactness"] <= 1
    missing = run(["measure", str(picture), "--method", "brihgt"], installed)
    assert missing.returncode == 2
    assert "did you mean 'bright'" in missing.stderr


def test_an_entry_point_that_is_no_record_is_one_line(
    tmp_path: Path, installed: dict[str, str]
) -> None:
    points = tmp_path / "rockshape_plugins-1.0.dist-info" / "entry_points.txt"
    points.write_text("[rockshape.methods]\nbright = tests.plugins.bright_method:AREA\n")
    picture = tmp_path / "i.png"
    cv2.imwrite(str(picture), np.rint(255 * IMAGE).astype(np.uint8))
    done = run(["measure", str(picture)], installed)
    assert done.returncode == 2
    assert done.stderr.strip() == (
        "rockshape: entry point 'bright' of rockshape.methods: expected a Method, found Measure"
    )
    points.write_text("[rockshape.methods]\nbright = tests.plugins.absent:METHOD\n")
    done = run(["measure", str(picture)], installed)
    assert done.returncode == 2
    assert done.stderr.startswith(
        "rockshape: entry point 'bright' of rockshape.methods: expected a Method, "
        "found ModuleNotFoundError: "
    )
    assert done.stderr.count("\n") == 1


def test_an_own_finder_is_one_record() -> None:
    found = rockshape.measure(1 - IMAGE, method="robust", find=FINDER)
    assert [rock.area_px for rock in found] == [DISC.sum()]


def test_an_entry_point_adds_a_finder_to_the_command(
    tmp_path: Path, installed: dict[str, str]
) -> None:
    picture, table = tmp_path / "i.png", tmp_path / "t.csv"
    cv2.imwrite(str(picture), np.rint(255 * (1 - IMAGE)).astype(np.uint8))
    done = run(["measure", str(picture), "--find", "dark", "--out", str(table)], installed)
    assert done.returncode == 0, done.stderr
    assert pd.read_csv(table)["area_px"].tolist() == [DISC.sum()]
    missing = run(["measure", str(picture), "--find", "drak"], installed)
    assert missing.returncode == 2
    assert "did you mean 'dark'" in missing.stderr


def test_a_measure_declares_what_it_is_held_to_beside_its_formula() -> None:
    own = replace(ROBUST, measures=(COMPACTNESS,))
    found = rockshape.measure(IMAGE, method=own, labels=DISC)
    truth = pd.DataFrame({"id": [1], "outline_roundness": [1.0]})
    scored = validation.score(found, SimpleNamespace(labels=DISC, truth=truth)).measures
    assert scored[["measure", "truth"]].to_numpy().tolist() == [
        ["compactness", "outline_roundness"]
    ]


def test_an_own_measure_is_held_to_the_gate_of_the_docs(
    tmp_path: Path, installed: dict[str, str]
) -> None:
    text = (ROOT / "docs" / "extending.md").read_text(encoding="utf-8")
    suite = next(block for block in TOML.findall(text) if 'name = "compactness"' in block)
    (tmp_path / "compactness.toml").write_text(suite, encoding="utf-8")
    command = [sys.executable, "-m", "rockshape.cli", "validate", "run", "--jobs", "1"]
    done = subprocess.run(
        [*command, "--suite", "compactness.toml", "--out", "out"],
        cwd=tmp_path, env=installed, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    assert "passed: 1 of 1 gates" in done.stdout


def test_the_distribution_of_the_docs_names_records_of_their_groups() -> None:
    text = (ROOT / "docs" / "extending.md").read_text(encoding="utf-8")
    project = next(block for block in TOML.findall(text) if "[build-system]" in block)
    groups = tomllib.loads(project)["project"]["entry-points"]
    records = {
        "rockshape.measures": ("compactness_measure", Measure),
        "rockshape.methods": ("bright_method", Method),
        "rockshape.finders": ("dark_finder", Finder),
        "rockshape.formats": ("ascii_range", RangeFormat),
        "rockshape.kinds": ("coins_kind", Kind),
        "synth.sensors": ("scanner", Sensor),
    }
    assert set(groups) == set(records)
    for group, (module, record) in records.items():
        (named,) = groups[group].values()
        folder = "tests.synth.plugins" if group.startswith("synth") else "tests.plugins"
        found = getattr(import_module(f"{folder}.{module}"), named.partition(":")[2])
        assert isinstance(found, record)
