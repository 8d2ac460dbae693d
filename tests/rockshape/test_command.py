"""`rockshape measure`: what it reads and writes."""

import json
import re
from pathlib import Path

import cv2
import numpy as np
import pandas as pd
import pytest

from rockshape.cli import main
from rockshape.io import read_labels, read_pixels
from rockshape.io.pixels import to_grey
from rockshape.measurement import DESCRIPTORS, columns, to_frame
from rockshape.method import methods
from rockshape.observation import Observation
from rockshape.pipeline import measure
from tests.paths import GRAINS_IMAGE, GRAINS_LABELS, MARS_IMAGE, MARS_RANGE


def test_the_readme_command_writes_table_labels_and_picture(tmp_path: Path) -> None:
    table, labels, picture = tmp_path / "m.csv", tmp_path / "l.png", tmp_path / "o.png"
    arguments = ["measure", str(MARS_IMAGE), "--range", str(MARS_RANGE), "--out", str(table)]
    assert main([*arguments, "--labels-out", str(labels), "--overlay", str(picture)]) == 0
    frame = pd.read_csv(table)
    assert len(frame) >= 3
    written = cv2.imread(str(labels), cv2.IMREAD_UNCHANGED)
    assert written.dtype == np.uint16
    assert np.unique(written)[1:].tolist() == frame["rock"].tolist()
    assert cv2.imread(str(picture)).shape == (992, 1024, 3)


def coco(folder: Path, annotations: list[dict]) -> Path:
    path = folder / "rocks.json"
    images = [{"id": 7, "width": 256, "height": 248, "file_name": f"gray/{MARS_IMAGE.name}"}]
    other = {"id": 8, "width": 9, "height": 9, "file_name": "other.png"}
    path.write_text(json.dumps({"images": [*images, other], "annotations": annotations}))
    return path


def test_coco_polygons_and_run_lengths_are_labels(tmp_path: Path) -> None:
    # corners at pixel corners: columns 10 to 29, rows 20 to 59
    polygon = [[10, 20, 30, 20, 30, 60, 10, 60]]
    mask = np.zeros((248, 256), dtype=bool)
    mask[100:140, 50:90] = True
    flat = np.concatenate([[False], mask.ravel(order="F"), [False]])
    edges = [0, *np.flatnonzero(flat[1:] != flat[:-1]).tolist(), mask.size]
    runs = {"size": [248, 256], "counts": np.diff(edges).tolist()}
    annotations = [
        {"id": 3, "image_id": 7, "segmentation": polygon},
        {"id": 4, "image_id": 7, "segmentation": runs},
        {"id": 5, "image_id": 8, "segmentation": polygon},
    ]
    table = tmp_path / "t.csv"
    labels = coco(tmp_path, annotations)
    arguments = ["measure", str(MARS_IMAGE), "--labels", str(labels), "--out", str(table)]
    assert main(arguments) == 0
    frame = pd.read_csv(table)
    assert frame["rock"].tolist() == [3, 4]
    assert frame["area_px"].tolist() == [20 * 40, 40 * 40]


def test_a_ply_with_a_vertex_for_each_pixel_is_range(tmp_path: Path) -> None:
    points = np.load(MARS_RANGE)["xyz"].reshape(-1, 3)
    path = tmp_path / "range.ply"
    header = "ply\nformat binary_little_endian 1.0\n"
    header += f"element vertex {len(points)}\n"
    header += "".join(f"property float {axis}\n" for axis in "xyz") + "end_header\n"
    path.write_bytes(header.encode() + points.astype("<f4").tobytes())
    tables = []
    for name in (path, MARS_RANGE):
        tables.append(tmp_path / f"{name.suffix}.csv")
        arguments = ["measure", str(MARS_IMAGE), "--range", str(name), "--out", str(tables[-1])]
        assert main(arguments) == 0
    assert tables[0].read_text() == tables[1].read_text()


def test_the_report_is_one_page_with_every_rock(tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    arguments = ["measure", str(GRAINS_IMAGE), "--labels", str(GRAINS_LABELS)]
    assert main([*arguments, "--out", str(tmp_path / "t.csv"), "--report", str(page)]) == 0
    text = page.read_text()
    assert text.count('<tr id="row-') == 124
    assert text.count('<g class="rock"') == 124
    assert "data:image/jpeg;base64," in text
    assert not re.search(r"""(?:src|href)=["']?(?:http|//)|url\((?!#)|@import""", text)


@pytest.mark.parametrize("method", methods())
def test_the_report_shows_the_columns_of_its_method(tmp_path: Path, method: str) -> None:
    page, table = tmp_path / "page.html", tmp_path / "t.csv"
    arguments = ["measure", str(MARS_IMAGE), "--range", str(MARS_RANGE), "--method", method]
    outputs = ["--out", str(table), "--report", str(page), "--descriptors"]
    assert main([*arguments, *outputs]) == 0
    text = page.read_text()
    written = pd.read_csv(table)
    assert list(written.columns) == list(columns(method, descriptors=True))
    for column in (*(entry.column for entry in methods()[method].measures), *DESCRIPTORS.values()):
        assert text.count(f'<th data-name="{column}"') == 1
    assert f"Method <code>{method}</code>" in text
    assert "“”" not in text  # a measure that the paper has not has no name there


def test_labels_read_back_give_the_same_flat_measures(tmp_path: Path) -> None:
    first, second, labels = tmp_path / "a.csv", tmp_path / "b.csv", tmp_path / "l.png"
    arguments = ["measure", str(MARS_IMAGE), "--range", str(MARS_RANGE), "--method", "paper"]
    assert main([*arguments, "--out", str(first), "--labels-out", str(labels)]) == 0
    assert main([*arguments, "--out", str(second), "--labels", str(labels)]) == 0
    same = ["rock", "area_px", "axis_ratio", "angularity_2d_deg", "sphericity_3d"]
    pd.testing.assert_frame_equal(pd.read_csv(first)[same], pd.read_csv(second)[same])


@pytest.mark.parametrize("ending", [".csv", ".json", ".parquet"])
def test_every_table_form_holds_the_same(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"grains{ending}"
    arguments = ["measure", str(GRAINS_IMAGE), "--labels", str(GRAINS_LABELS), "--out", str(path)]
    assert main(arguments) == 0
    read = {".csv": pd.read_csv, ".json": pd.read_json, ".parquet": pd.read_parquet}[ending]
    image = to_grey(read_pixels(GRAINS_IMAGE))
    labels = read_labels(GRAINS_LABELS, shape=image.shape).to_labels()
    expected = to_frame(measure(Observation(image=image), labels=labels, method="robust"))
    # CSV and JSON keep nine digits; an empty CSV field reads as NaN
    frame = read(path)[list(expected.columns)].fillna({"flags": ""})
    pd.testing.assert_frame_equal(frame, expected, check_dtype=False, rtol=1e-8)


def test_without_out_the_table_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["measure", str(GRAINS_IMAGE), "--labels", str(GRAINS_LABELS)]) == 0
    printed = capsys.readouterr()
    assert printed.out.splitlines()[0].startswith("rock,row,col,area_px")
    assert "124 rocks" in printed.err


def test_depth_with_a_camera_is_range_too(tmp_path: Path) -> None:
    depth = np.full((40, 50), 2000, dtype=np.uint16)
    depth[10:30, 10:35] = 1800
    cv2.imwrite(str(tmp_path / "depth.png"), depth)
    cv2.imwrite(str(tmp_path / "image.png"), np.zeros((40, 50), dtype=np.uint8))
    camera = {"fx": 50, "fy": 50, "cx": 24.5, "cy": 19.5, "width": 50, "height": 40}
    (tmp_path / "camera.json").write_text(json.dumps(camera | {"depth_scale": 1.0}))
    arguments = ["--range", str(tmp_path / "depth.png"), "--camera", str(tmp_path / "camera.json")]
    out = ["--out", str(tmp_path / "t.csv")]
    assert main(["measure", str(tmp_path / "image.png"), *arguments, *out]) == 0
    frame = pd.read_csv(tmp_path / "t.csv")
    assert frame["area_px"].tolist() == [20 * 25]


def test_range_that_is_nan_everywhere_still_measures_the_flat_columns(tmp_path: Path) -> None:
    range_path = tmp_path / "nan.npy"
    np.save(range_path, np.full((512, 512, 3), np.nan))
    table = tmp_path / "t.csv"
    arguments = ["--labels", str(GRAINS_LABELS), "--range", str(range_path), "--out", str(table)]
    assert main(["measure", str(GRAINS_IMAGE), *arguments]) == 0
    frame = pd.read_csv(table)
    assert (frame["axis_ratio"].notna() | frame["truncated"]).all()
    assert frame["reason"].str.contains("no range").all()


def test_range_that_is_zero_everywhere_is_no_range(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    range_path = tmp_path / "zero.npy"
    np.save(range_path, np.zeros((512, 512, 3)))
    table = tmp_path / "t.csv"
    arguments = ["--labels", str(GRAINS_LABELS), "--range", str(range_path), "--out", str(table)]
    assert main(["measure", str(GRAINS_IMAGE), *arguments]) == 0
    frame = pd.read_csv(table)
    assert frame["sphericity_3d"].isna().all()
    assert frame["reason"].str.contains("no range").all()
    assert "range of 262144 of 262144 pixels left out (zero 262144)" in capsys.readouterr().err
