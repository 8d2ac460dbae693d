"""Summary line of `rockshape measure`: what was measured, what is missing and why; and --find."""

from pathlib import Path

import cv2
import numpy as np
import pandas as pd
import pytest

from rockshape.cli import main
from rockshape.method import ROBUST
from tests.paths import GRAINS_IMAGE, GRAINS_LABELS, MARS_IMAGE, MARS_RANGE

NO_RANGE = "no range: 3-D measures are empty; give --range FILE (and --camera FILE for z-depth)"
FLAT = [each.column for each in ROBUST.measures if not each.needs_range]
SOLID = [each.column for each in ROBUST.measures if each.needs_range]


def measured(
    capsys: pytest.CaptureFixture[str], folder: Path, *arguments: object
) -> tuple[pd.DataFrame, list[str]]:
    """The table of a run, and the parts of its summary line."""
    table = folder / "table.csv"
    assert main(["measure", *map(str, arguments), "--flags", "--out", str(table)]) == 0
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    return pd.read_csv(table, keep_default_na=True), printed.err.strip().split("; ")


def test_without_range_the_line_says_what_is_missing_and_what_to_give(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    frame, parts = measured(capsys, tmp_path, GRAINS_IMAGE, "--labels", GRAINS_LABELS)
    missing = frame[FLAT].isna().any(axis=1)
    cut = frame["truncated"] & missing
    small, touching = (
        int(frame.loc[missing, "reason"].str.contains(rf"\b{why} \(").sum())
        for why in ("too small", "contacts")
    )
    assert small > cut.sum() > touching > 0  # the more frequent reason comes first
    assert 0 < missing.sum() < len(frame)
    why = f"too small {small}, truncated {cut.sum()}, contacts {touching}"
    assert "; ".join(parts) == (
        f"{len(frame)} rocks; all 2-D measures of {(~missing).sum()}, some missing in "
        f"{missing.sum()} ({why}); {NO_RANGE}"
    )


def test_with_range_the_3d_measures_are_counted_apart(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    frame, parts = measured(capsys, tmp_path, MARS_IMAGE, "--range", MARS_RANGE)
    solid = frame[SOLID].isna().any(axis=1)
    assert parts[0] == f"{len(frame)} rocks"
    assert parts[2].startswith(
        f"all 3-D measures of {(~solid).sum()}, some missing in {solid.sum()} ("
    )
    assert parts[3].startswith("ground scatter 0.1")
    assert parts[4] == "camera resected from the range, residual 0.24 px"


def test_no_rock_and_one_rock(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    image, labels = tmp_path / "image.png", tmp_path / "labels.npy"
    cv2.imwrite(str(image), np.full((60, 60), 90, dtype=np.uint8))
    np.save(labels, np.zeros((60, 60), dtype=int))
    _, parts = measured(capsys, tmp_path, image, "--labels", labels)
    assert "; ".join(parts) == f"no rocks; {NO_RANGE}"
    rows, cols = np.mgrid[:60, :60]
    np.save(labels, ((rows - 30) ** 2 + (cols - 30) ** 2 < 400).astype(int))
    _, parts = measured(capsys, tmp_path, image, "--labels", labels)
    assert "; ".join(parts) == f"1 rock; all 2-D measures of each; {NO_RANGE}"
    np.save(labels, ((rows == 30) & (cols < 3)).astype(int))
    _, parts = measured(capsys, tmp_path, image, "--labels", labels)
    assert parts[1].startswith("some 2-D measures missing in every rock (")


@pytest.mark.parametrize(
    ("find", "branches"),
    [
        ("range", {"range"}),
        ("image", {"image"}),
        ("both", {"image", "range"}),  # the mesh is coarse, so that the picture comes first
        ("network", {"image"}),
        ("published", {"range"}),
    ],
)
def test_find_says_how_rocks_are_found_whatever_the_method(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, find: str, branches: set[str]
) -> None:
    frames = [
        measured(capsys, tmp_path, MARS_IMAGE, "--range", MARS_RANGE, "--find", find, *method)[0]
        for method in ([], ["--method", "paper"])
    ]
    assert set(frames[0]["branch"]) == branches
    same = ["rock", "area_px", "branch"]
    pd.testing.assert_frame_equal(frames[0][same], frames[1][same])
    assert "roundness" in frames[0]
    assert "angularity_2d_deg" in frames[1]


def test_the_image_alone_finds_rocks_for_the_papers_measures(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    arguments = [MARS_IMAGE, "--method", "paper", "--find", "image"]
    frame, parts = measured(capsys, tmp_path, *arguments)
    assert len(frame) > 0
    assert "; ".join(parts).endswith(NO_RANGE)
