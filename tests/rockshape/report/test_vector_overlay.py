"""Overlay as SVG: a document with each rock's lines where its pixels are."""

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import cv2
import numpy as np
import pytest

import rockshape
from rockshape.cli import main
from rockshape.report.vector_overlay import vector_overlay

NAMES = {"s": "http://www.w3.org/2000/svg"}


def square() -> np.ndarray:
    mask = np.zeros((40, 60), np.uint8)
    mask[10:30, 20:45] = 1
    return mask


def test_each_rock_is_a_group_with_its_outline_in_pixels() -> None:
    found = rockshape.measure(labels=square().astype(np.int32), scale="1mm")
    root = ET.fromstring(vector_overlay(found))
    assert root.get("viewBox") == "0 0 60 40"
    (group,) = root.findall("s:g", NAMES)
    assert group.get("id") == "rock-1"
    numbers = re.findall(r"-?[0-9.]+", group.find("s:path", NAMES).get("d"))
    x, y = np.array(numbers, dtype=float).reshape(-1, 2).T
    # pixel columns 20 to 44 reach from 20 to 45 of the picture
    assert (x.min(), x.max()) == (pytest.approx(20, abs=0.6), pytest.approx(45, abs=0.6))
    assert (y.min(), y.max()) == (pytest.approx(10, abs=0.6), pytest.approx(30, abs=0.6))
    words = [text.text for text in root.findall("s:text", NAMES)]
    assert words == ["10 mm"]


def test_the_command_writes_it(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "mask.png"), square())
    cv2.imwrite(str(tmp_path / "image.png"), 90 * square() + 60)
    words = [str(tmp_path / "image.png"), "--labels", str(tmp_path / "mask.png")]
    out = ["--out", str(tmp_path / "t.csv"), "--overlay", str(tmp_path / "o.svg")]
    assert main(["measure", *words, *out]) == 0
    assert (tmp_path / "o.svg").read_text().startswith("<svg ")
