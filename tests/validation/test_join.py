"""The join of truth and measurement, and the truth's files."""

import json

import cv2
import numpy as np
import pandas as pd
import pytest

from rockshape.measurement import to_frame
from rockshape.observation import Observation
from rockshape.pipeline import measure
from validation.errors import InputError
from validation.records.join import RecordKey, join
from validation.records.truth import (
    read_instances,
    read_scene_truth,
    read_shape_truth,
    rock_columns,
    view_columns,
)

PLACE = RecordKey("yard", "multiview", "", 0, 10000, 2, "paper")


def discs(*centres: tuple[int, int]) -> np.ndarray:
    """Return labels 1, 2, … of discs of 12 px radius."""
    rows, cols = np.mgrid[0:80, 0:160]
    labels = np.zeros((80, 160), np.int32)
    for index, (row, col) in enumerate(centres):
        labels[(rows - row) ** 2 + (cols - col) ** 2 <= 144] = index + 1
    return labels


def test_every_rock_has_one_row() -> None:
    true = discs((20, 20), (20, 80), (60, 140))
    measured = discs((60, 140), (20, 21), (60, 60))  # the third, the first, and one that is none
    measurement = measure(Observation(image=np.zeros((80, 160), np.float32)), labels=measured)
    truth = pd.DataFrame({"instance": [0, 1, 2], "truth_roundness": 1.0, "eligible": True})
    rows = join(PLACE, truth, true, measurement.labels, to_frame(measurement), min_iou=0.5)
    assert rows["status"].to_list() == ["matched", "missed", "matched", "extra"]
    assert rows["rock"].fillna(0).to_list() == [2, 0, 1, 3]
    assert rows["instance"].fillna(-1).to_list() == [0, 1, 2, -1]
    assert rows["eligible"].to_list() == [True, True, True, False]
    assert rows["iou"].isna().to_list() == [False, True, False, True]
    assert rows["iou"][2] == 1.0
    assert np.isfinite(rows["axis_ratio"]).to_list() == [True, False, True, True]
    assert (rows["view"] == 2).all()
    assert (rows["method"] == "paper").all()


def test_an_empty_measurement_misses_all() -> None:
    measurement = measure(
        Observation(image=np.zeros((80, 160), np.float32)),
        labels=np.zeros((80, 160), np.int32),
        method="paper",
    )
    truth = pd.DataFrame({"instance": [0], "eligible": True})
    rows = join(
        PLACE, truth, discs((20, 20)), measurement.labels, to_frame(measurement), min_iou=0.5
    )
    assert rows["status"].to_list() == ["missed"]
    assert rows["angularity_2d_deg"].isna().all()


ROCK = {
    "instance": 0,
    "obj_id": 1,
    "family": "ellipsoid",
    "half_axes_box_m": [0.3, 0.2, 0.1],
    "maximum_projection_sphericity": 0.55,
    "roundness": None,
    "wadell_sphericity": None,
    "more": "is allowed",
}
SEEN = {
    "instance": 0,
    "visible_fraction": 1.0,
    "truncated": False,
    "pixel_m": 0.003,
    "outline_axis_ratio": 0.8,
    "outline_roundness": None,
}


def test_truth_without_roundness_is_nan(tmp_path) -> None:
    path = tmp_path / "scene_gt_shape.json"
    path.write_text(json.dumps({"rocks": [ROCK], "views": {"0": [SEEN]}}), encoding="utf-8")
    truth = read_scene_truth(path)
    assert np.isnan(view_columns(truth.views["0"][0])["truth_outline_angularity"])
    columns = rock_columns(truth.rocks[0])
    assert np.isnan(columns["truth_roundness"])
    assert np.isnan(columns["truth_angularity"])
    assert columns["truth_axis_a_m"] == 0.3


@pytest.mark.parametrize("missing", ["instance", "roundness", "half_axes_box_m"])
def test_a_missing_field_is_named(tmp_path, missing) -> None:
    rock = {key: value for key, value in ROCK.items() if key != missing}
    path = tmp_path / "scene_gt_shape.json"
    path.write_text(json.dumps({"rocks": [rock], "views": {}}), encoding="utf-8")
    with pytest.raises(InputError, match=missing) as error:
        read_scene_truth(path)
    assert str(path) in str(error.value)


def test_unreadable_truth(tmp_path) -> None:
    cut = tmp_path / "cut.json"
    cut.write_text('{"rocks": [', encoding="utf-8")
    for path in (cut, tmp_path / "none.json", tmp_path):
        with pytest.raises(InputError, match=path.name):
            read_scene_truth(path)
        with pytest.raises(InputError, match="label image"):
            read_instances(path)
    table = tmp_path / "truth.csv"
    table.write_text("rock,roundness\n1,0.5\n", encoding="utf-8")
    with pytest.raises(InputError, match="area_px2"):
        read_shape_truth(table)
    with pytest.raises(InputError, match=r"none\.csv"):
        read_shape_truth(tmp_path / "none.csv")


def test_a_colour_image_is_no_label_image(tmp_path) -> None:
    cv2.imwrite(str(tmp_path / "c.png"), np.zeros((4, 4, 3), np.uint8))
    with pytest.raises(InputError, match=r"\(4, 4, 3\)"):
        read_instances(tmp_path / "c.png")
