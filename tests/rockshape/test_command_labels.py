"""`rockshape measure --labels` and `--instances`: the rocks of a file, and what the line tells."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from PIL import Image

from rockshape.cli import main

ROWS, COLS = np.mgrid[:120, :160]
DISC = np.hypot(ROWS - 40, COLS - 40) <= 30
RIGHT = np.hypot(ROWS - 40, COLS - 70) <= 30  # overlaps the disc
BAR = (ROWS >= 90) & (ROWS < 110) & (COLS >= 20) & (COLS < 100)


@pytest.fixture
def image(tmp_path: Path) -> Path:
    path = tmp_path / "scene.png"
    Image.fromarray(np.where(DISC | BAR, 200, 60).astype(np.uint8)).save(path)
    return path


def run(
    capsys: pytest.CaptureFixture[str], folder: Path, *arguments: object
) -> tuple[pd.DataFrame, str]:
    table = folder / "table.csv"
    assert main(["measure", *map(str, arguments), "--out", str(table)]) == 0
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    return pd.read_csv(table), printed.err


def counts(mask: np.ndarray) -> dict[str, Any]:
    flat = np.concatenate([[False], mask.ravel(order="F"), [False]])
    edges = [0, *np.flatnonzero(flat[1:] != flat[:-1]).tolist(), mask.size]
    return {"size": list(mask.shape), "counts": np.diff(edges).tolist()}


def coco(folder: Path, annotations: list[dict[str, Any]], encoding: str = "utf-8") -> Path:
    path = folder / "rocks.json"
    images = [{"id": 1, "height": 120, "width": 160, "file_name": "scene.png"}]
    path.write_text(json.dumps({"images": images, "annotations": annotations}), encoding=encoding)
    return path


def test_overlapping_rocks_are_measured_whole_with_their_ids(
    tmp_path: Path, image: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    entries = [
        {"id": number, "image_id": 1, "segmentation": counts(mask)}
        for number, mask in {0: DISC, 909000412806: RIGHT}.items()
    ]
    entries.append({"id": 5, "image_id": 1, "iscrowd": 1, "segmentation": counts(BAR)})
    entries.append({"id": 6, "image_id": 1})
    frame, line = run(capsys, tmp_path, image, "--labels", coco(tmp_path, entries, "utf-8-sig"))
    assert frame["rock"].tolist() == [0, 909000412806]
    assert frame["area_px"].tolist() == [DISC.sum(), RIGHT.sum()]
    assert frame["axis_ratio"].tolist() == pytest.approx([1, 1], abs=0.005)
    assert "2 of 4 annotations left out: 1 crowd (5), 1 without segmentation (6)" in line


def test_a_file_of_crowds_alone_has_no_rocks(
    tmp_path: Path, image: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    entry = {"id": 2**31, "image_id": 1, "iscrowd": 1, "segmentation": counts(BAR)}
    frame, line = run(capsys, tmp_path, image, "--labels", coco(tmp_path, [entry]))
    assert len(frame) == 0
    assert "1 crowd (2147483648)" in line


def test_a_mask_is_split_or_kept(
    tmp_path: Path, image: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "mask.png"
    Image.fromarray(((DISC | BAR) * 255).astype(np.uint8)).save(path)
    frame, line = run(capsys, tmp_path, image, "--labels", path)
    assert frame["area_px"].tolist() == [DISC.sum(), BAR.sum()]
    assert "one value (255) in 2 pieces" in line
    frame, line = run(capsys, tmp_path, image, "--labels", path, "--pieces", "keep")
    assert frame["rock"].tolist() == [255]
    assert frame["area_px"].tolist() == [DISC.sum()]
    assert "1 rock in pieces, the largest of each measured" in line


def test_a_folder_of_masks(tmp_path: Path, image: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "masks"
    folder.mkdir()
    for number, mask in {4: DISC, 12: RIGHT}.items():
        Image.fromarray(mask).save(folder / f"rock{number}.png")
    frame, _ = run(capsys, tmp_path, image, "--instances", folder)
    assert frame[["rock", "area_px"]].to_numpy().tolist() == [[4, DISC.sum()], [12, RIGHT.sum()]]
    arguments = ["measure", image, "--instances", folder, "--labels", folder / "rock4.png"]
    assert main([*map(str, arguments)]) == 2
    assert "--instances: expected it without --labels" in capsys.readouterr().err


def test_pixel_sizes_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import tifffile

    path = tmp_path / "scene.tif"
    pixels = np.where(DISC | BAR, 200, 60).astype(np.uint8)
    tifffile.imwrite(path, pixels, imagej=True, resolution=(4, 4), metadata={"unit": "mm"})
    np.save(tmp_path / "labels.npy", DISC)
    frame, line = run(capsys, tmp_path, path, "--labels", tmp_path / "labels.npy")
    assert frame["area_px"].tolist() == [DISC.sum()]
    assert "pixel size 0.25 mm" in line
