"""Sizes of outlines in px and mm: drawn ellipses, scale bars, range and level ground."""

import json
import math
from pathlib import Path

import cv2
import numpy as np
import pandas as pd
import pytest

import rockshape
from rockshape import InputError
from rockshape.cli import main
from rockshape.inputs.scale import parse_scale
from rockshape.rock.level_ground import LevelGround

CAMERA = {"fx": 400.0, "fy": 400.0, "cx": 149.5, "cy": 99.5, "width": 300, "height": 200}


def ellipse(a: float, b: float, turn_deg: float, *, x: float = 150, y: float = 100) -> np.ndarray:
    """Label image of an ellipse whose major axis is turned clockwise as seen."""
    rows, cols = np.mgrid[:200, :300].astype(np.float64)
    turn = math.radians(turn_deg)
    u = (cols - x) * math.cos(turn) + (rows - y) * math.sin(turn)
    v = (rows - y) * math.cos(turn) - (cols - x) * math.sin(turn)
    return ((u / a) ** 2 + (v / b) ** 2 <= 1).astype(np.int32)


def only(frame: pd.DataFrame) -> pd.Series:
    (row,) = (row for _, row in frame.iterrows())
    return row


@pytest.mark.parametrize("turn_deg", [0.0, 30.0, -60.0, 90.0])
def test_an_ellipse_has_its_axes_area_and_direction(turn_deg: float) -> None:
    a, b = 60.0, 30.0
    found = rockshape.measure(labels=ellipse(a, b, turn_deg), sizes=True)
    row = only(found.to_frame())
    assert row["major_axis_px"] == pytest.approx(2 * a, rel=0.01)
    assert row["minor_axis_px"] == pytest.approx(2 * b, rel=0.01)
    assert row["feret_max_px"] == pytest.approx(2 * a, rel=0.015)
    assert row["feret_min_px"] == pytest.approx(2 * b, rel=0.015)
    assert row["outline_area_px2"] == pytest.approx(math.pi * a * b, rel=0.005)
    assert row["equivalent_diameter_px"] == pytest.approx(2 * math.sqrt(a * b), rel=0.005)
    off = (row["orientation_deg"] - turn_deg + 90) % 180 - 90
    assert abs(off) < 0.5
    assert -90 < row["orientation_deg"] <= 90
    assert math.isnan(row["major_axis_mm"])
    rows, cols = np.nonzero(found.labels)
    assert (row["box_row"], row["box_col"]) == (rows.min(), cols.min())
    assert (row["height_px"], row["width_px"]) == (np.ptp(rows) + 1, np.ptp(cols) + 1)


def test_a_scale_gives_millimetres() -> None:
    labels = ellipse(60, 30, 20)
    row = only(rockshape.measure(labels=labels, scale="0.5mm").to_frame())
    for name in ("major_axis", "minor_axis", "feret_max", "feret_min", "equivalent_diameter"):
        assert row[f"{name}_mm"] == pytest.approx(0.5 * row[f"{name}_px"])
    assert row["outline_area_mm2"] == pytest.approx(0.25 * row["outline_area_px2"])
    assert row["pixel_mm"] == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("0.39mm", 0.39e-3),
        ("1 cm", 0.01),
        ("40,52:540,52=100mm", 0.1 / 500),
        ("0,0:30,40=1in", 0.0254 / 50),
        ("1.5,2 : 4.5,6 = 10 mm", 0.01 / 5),
    ],
)
def test_scales_are_read(text: str, metres: float) -> None:
    assert parse_scale(text) == pytest.approx(metres)


@pytest.mark.parametrize(
    "text", ["", "0.39", "0mm", "-1mm", "3px", "1,1:1,1=10mm", "1,1:2,2=", "1,1:2,2=10", "nan mm"]
)
def test_other_scales_are_refused(text: str) -> None:
    with pytest.raises(InputError, match="scale"):
        parse_scale(text)


def test_range_tells_lengths_on_each_rock() -> None:
    # a sphere of radius 0.1 m at 2 m: its silhouette's radius is f·R/√(d² − R²)
    radius_m, far_m = 0.1, 2.0
    rows, cols = np.mgrid[:200, :300].astype(np.float64)
    x, y = (cols - CAMERA["cx"]) / CAMERA["fx"], (rows - CAMERA["cy"]) / CAMERA["fy"]
    ray = np.stack([x, y, np.ones_like(x)], axis=-1)
    ray /= np.linalg.norm(ray, axis=-1, keepdims=True)
    along = ray[..., 2] * far_m
    under = along**2 - far_m**2 + radius_m**2
    hit = under >= 0
    points = np.where(
        hit[..., None], ray * (along - np.sqrt(np.maximum(under, 0)))[..., None], np.nan
    )
    found = rockshape.measure(
        range_m=points, camera=CAMERA, labels=hit.astype(np.int32), sizes=True
    )
    row = only(found.to_frame())
    # the visible cap is nearer than the silhouette by up to R: half of that in the median
    assert row["major_axis_mm"] == pytest.approx(2e3 * radius_m, rel=0.04)
    assert row["pixel_mm"] == pytest.approx(1e3 * np.nanmedian(points[..., 2]) / CAMERA["fx"])


def test_level_ground_tells_lengths_by_the_foot_of_a_rock() -> None:
    ground = LevelGround(height_m=1.5, tilt_deg=30.0)
    labels = ellipse(20, 10, 0, y=120)
    found = rockshape.measure(labels=labels, camera=CAMERA, level_ground=ground)
    foot_row = np.nonzero(labels.any(axis=1))[0].max() + 0.5
    # the ray through the foot, turned by the tilt, meets the plane 1.5 m below
    down = math.radians(30.0) + math.atan((foot_row - CAMERA["cy"]) / CAMERA["fy"])
    slant = 1.5 / math.sin(down)
    depth = slant * math.cos(down - math.radians(30.0))
    assert only(found.to_frame())["pixel_mm"] == pytest.approx(1e3 * depth / CAMERA["fx"])


def test_above_the_horizon_there_is_no_length() -> None:
    ground = LevelGround(height_m=1.5, tilt_deg=0.0)
    labels = ellipse(20, 10, 0, y=40)
    found = rockshape.measure(labels=labels, camera=CAMERA, level_ground=ground)
    assert math.isnan(only(found.to_frame())["pixel_mm"])


def test_two_scales_are_refused() -> None:
    labels, flat = ellipse(20, 10, 0), np.full((200, 300), 2.0)
    level = LevelGround(1.0, 10.0)
    with pytest.raises(InputError, match="camera height"):
        rockshape.measure(labels=labels, camera=CAMERA, scale="1mm", level_ground=level)
    with pytest.raises(InputError, match="no range"):
        rockshape.measure(labels=labels, camera=CAMERA, range_m=flat, scale="1mm")
    with pytest.raises(InputError, match="expected a camera"):
        rockshape.measure(labels=labels, level_ground=level)


def test_the_command_adds_the_columns(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mask = ellipse(40, 20, 0).astype(np.uint8)
    cv2.imwrite(str(tmp_path / "mask.png"), mask)
    cv2.imwrite(str(tmp_path / "image.png"), 90 * mask + 60)
    (tmp_path / "camera.json").write_text(json.dumps(CAMERA))
    table = tmp_path / "rocks.parquet"
    common = ["measure", str(tmp_path / "image.png"), "--labels", str(tmp_path / "mask.png")]
    common += ["--out", str(table)]

    assert main([*common, "--scale", "10,10:110,10=50mm"]) == 0
    assert only(pd.read_parquet(table))["major_axis_mm"] == pytest.approx(40, rel=0.01)
    assert main([*common, "--sizes"]) == 0
    assert math.isnan(only(pd.read_parquet(table))["major_axis_mm"])
    assert main(common) == 0
    assert "major_axis_px" not in pd.read_parquet(table)
    height = ["--camera-height", "1.5m", "--tilt", "30", "--camera", str(tmp_path / "camera.json")]
    assert main([*common, *height]) == 0
    assert only(pd.read_parquet(table))["pixel_mm"] > 0
    capsys.readouterr()
    assert main([*common, "--tilt", "30"]) == 2
    assert "--camera-height and --tilt together" in capsys.readouterr().err
    assert main([*common, "--scale", "40"]) == 2
    assert "0.39mm" in capsys.readouterr().err
