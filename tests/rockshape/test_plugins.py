"""A method, a measure and a finder, each in one file of its own, found by entry points."""

import os
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pandas as pd
import pytest

import rockshape
from rockshape.pipeline import measure
from tests.plugins.bright_method import METHOD
from tests.plugins.concavity_measure import CONCAVITY
from tests.plugins.dark_finder import FINDER

ROOT = Path(__file__).parents[2]
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
        "[rockshape.measures]\nconcavity = tests.plugins.concavity_measure:CONCAVITY\n"
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
    assert 0 <= row["concavity"] < 0.02
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
    assert CONCAVITY.expected_trait == "angularity"
    assert CONCAVITY.view_truth == "outline_angularity"
    assert CONCAVITY.figure is not None
    assert CONCAVITY.figure().axes == []
