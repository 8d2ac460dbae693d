"""Outlines in map coordinates: of GeoTIFFs as they tie pixels to a map."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import tifffile

from rockshape.cli import main
from rockshape.io import read_picture

EAST, NORTH = 440000.0, 4650000.0
SCALE = [(33550, "d", 3, (0.01, 0.01, 0.0), True)]
FLAT = [(33550, "d", 3, (0.01, 0.0, 0.0), True)]
TIE = [(33922, "d", 6, (0.0, 0.0, 0.0, EAST, NORTH, 0.0), True)]
TURNED = [0.0, 0.01, 0.0, EAST, 0.01, 0.0, 0.0, NORTH, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]


def keys(*pairs: tuple[int, int]) -> list[tuple[Any, ...]]:
    told = [1, 1, 0, len(pairs)]
    for key, value in pairs:
        told += [key, 0, 1, value]
    return [(34735, "H", len(told), tuple(told), True)]


UTM = keys((1024, 1), (3072, 32612))


def orthophoto(folder: Path, tags: list[tuple[Any, ...]]) -> Path:
    path = folder / "bar.tif"
    tifffile.imwrite(path, np.zeros((60, 80), np.uint8), extratags=tags)
    return path


@pytest.mark.parametrize(
    ("tags", "first", "epsg"),
    [
        (SCALE + TIE + UTM, (EAST + 0.005, NORTH - 0.005), 32612),  # the corner is tied
        (SCALE + TIE + keys((1024, 1), (1025, 2), (3072, 32612)), (EAST, NORTH), 32612),
        ([(34264, "d", 16, tuple(TURNED), True), *UTM], (EAST + 0.005, NORTH + 0.005), 32612),
        (SCALE + TIE + keys((1024, 2), (2048, 4326)), (EAST + 0.005, NORTH - 0.005), 4326),
        (SCALE + TIE + keys((1024, 1), (3072, 32767)), (EAST + 0.005, NORTH - 0.005), None),
    ],
)
def test_the_first_pixels_centre_lies_where_the_tags_say(
    tmp_path: Path, tags: list[tuple[Any, ...]], first: tuple[float, float], epsg: int | None
) -> None:
    frame = read_picture(orthophoto(tmp_path, tags)).map_frame
    assert frame is not None
    assert frame.place(np.zeros((1, 2)))[0] == pytest.approx(first, abs=1e-6)
    assert frame.epsg == epsg


@pytest.mark.parametrize("tags", [[], SCALE + TIE, SCALE + UTM, TIE + UTM, FLAT + TIE + UTM])
def test_a_tiff_that_ties_nothing_has_no_map(tmp_path: Path, tags: list[tuple[Any, ...]]) -> None:
    assert read_picture(orthophoto(tmp_path, tags)).map_frame is None


def test_a_turned_page_has_no_map(tmp_path: Path) -> None:
    tags = [*SCALE, *TIE, *UTM, (274, "H", 1, 6, True)]
    assert read_picture(orthophoto(tmp_path, tags)).map_frame is None


def measured(folder: Path, tags: list[tuple[Any, ...]], *more: str) -> int:
    labels = np.zeros((60, 80), np.uint8)
    rows, cols = np.mgrid[:60, :80]
    labels[np.hypot(rows - 20, cols - 30) < 12] = 7
    labels[np.hypot(rows - 45, cols - 60) < 3] = 9
    tifffile.imwrite(folder / "labels.tif", labels)
    image, out = str(orthophoto(folder, tags)), str(folder / "rocks.csv")
    arguments = ["measure", image, "--labels", str(folder / "labels.tif"), "--out", out]
    return main([*arguments, "--map", str(folder / "rocks.geojson"), *more])


def test_outlines_are_laid_on_the_map_with_the_tables_values(tmp_path: Path) -> None:
    assert measured(tmp_path, SCALE + TIE + UTM) == 0
    layer = json.loads((tmp_path / "rocks.geojson").read_text())
    assert layer["crs"]["properties"]["name"] == "urn:ogc:def:crs:EPSG::32612"
    large, small = layer["features"]
    ring = np.array(large["geometry"]["coordinates"][0])
    assert ring[0].tolist() == ring[-1].tolist()
    x, y = (ring[:-1] - ring[0]).T
    area = np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) / 2
    pixels = int((np.hypot(*np.mgrid[-12:13, -12:13]) < 12).sum())
    assert area == pytest.approx(1e-4 * pixels, rel=0.01)  # counterclockwise
    middle = (ring.min(axis=0) + ring.max(axis=0)) / 2
    assert middle == pytest.approx([EAST + 0.305, NORTH - 0.205], abs=1e-3)
    table = pd.read_csv(tmp_path / "rocks.csv")
    assert [large["id"], small["id"]] == table["rock"].tolist() == [7, 9]
    assert set(large["properties"]) == set(table.columns)
    assert large["properties"]["roundness"] == pytest.approx(table["roundness"][0], rel=1e-8)
    assert large["properties"]["sphericity_3d"] is None


def test_degrees_of_wgs_84_need_no_system(tmp_path: Path) -> None:
    assert measured(tmp_path, SCALE + TIE + keys((1024, 2), (2048, 4326))) == 0
    assert "crs" not in json.loads((tmp_path / "rocks.geojson").read_text())


def test_an_image_without_a_map_is_refused_before_it_is_measured(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert measured(tmp_path, []) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert "--map: expected an image with map coordinates" in told
    assert not (tmp_path / "rocks.csv").exists()
    assert not (tmp_path / "rocks.geojson").exists()
