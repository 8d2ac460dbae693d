"""Provenance in the files of tables: version, options, hashed inputs, units."""

import hashlib
import json
from importlib.metadata import version
from pathlib import Path

import cv2
import numpy as np
import pyarrow.parquet as pq
import pytest

from rockshape.cli import main


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Current folder with two pictures and one mask for both."""
    monkeypatch.chdir(tmp_path)
    mask = np.zeros((60, 80), np.uint8)
    cv2.circle(mask, (40, 30), 15, 1, -1)
    cv2.imwrite("mask.png", mask)
    for name in ("a", "b"):
        cv2.imwrite(f"{name}.png", 90 * mask + 60)


def run(*words: str) -> None:
    assert main(["measure", *words, "--labels", "mask.png", "--scale", "2mm"]) == 0


def within(path: str) -> dict:
    return json.loads(pq.read_schema(path).metadata[b"rockshape"])


def digest(path: str) -> str:
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def test_a_csv_has_a_side_file_and_a_parquet_file_none() -> None:
    run("a.png", "--out", "t.csv")
    run("a.png", "--out", "t.parquet")
    told = json.loads(Path("t.csv.meta.json").read_text())
    assert told == within("t.parquet")
    assert not Path("t.parquet.meta.json").exists()
    assert told["rockshape"] == version("rockshape")
    assert told["method"] == "robust"
    assert told["options"]["scale"] == "2mm"
    assert {each["role"]: each["sha256"] for each in told["inputs"]} == {
        "image": digest("a.png"),
        "labels": digest("mask.png"),
    }
    assert told["columns"]["major_axis_mm"]["unit"] == "mm"
    field = pq.read_schema("t.parquet").field("major_axis_mm")
    assert field.metadata[b"unit"] == b"mm"


@pytest.mark.parametrize("out", ["t.csv", "t.parquet"])
def test_a_batch_tells_the_inputs_of_all_images(out: str) -> None:
    run("a.png", "b.png", "--out", out, "--jobs", "1")
    told = within(out) if out == "t.parquet" else json.loads(Path(f"{out}.meta.json").read_text())
    images = [each["sha256"] for each in told["inputs"] if each["role"] == "image"]
    assert images == [digest("a.png"), digest("b.png")]
    assert told["columns"]["image"]["description"]
