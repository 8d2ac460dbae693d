"""Every format that is read gives the measures that the same scene gives from PNG and NPY.

To 0.5 % in every column of the table: rocks are found in images, outlined by labels and measured
with range. NPY holds range to the digits that the format has, 0.1 mm of PNG and PGM and 0.01 mm of
tables, and PNG the picture that OpenCV finds in a JPEG.
"""

import json
from collections.abc import Callable, Mapping
from pathlib import Path

import cv2
import numpy as np
import pandas as pd
import pytest

import rockshape
from rockshape.io.registry import CAMERAS, IMAGES, LABELS, RANGES, FormatRegistry
from tests.rockshape.io import scene_files, test_camera_formats
from tests.rockshape.io import test_range_formats as range_files
from tests.rockshape.io.archive_products import pds3_product, pds4_product
from tests.rockshape.io.sphere_scene import CAMERA, measure_files, sphere_scene
from tests.rockshape.test_cahv import pds4_label

TOLERANCE = 0.005
FEWEST_FORMATS = 25
Range = tuple[Callable[..., Path], Mapping[str, float]]
STEP_M, DECIMALS = 1e-4, 5


def _pds4(folder: Path, scene: object) -> Path:
    return pds4_product(folder / "xyz.xml", range_files.holed(scene.points_m, 0), missing=0.0)


XYZ, RASTERS = range_files.XYZ, range_files.RASTERS
RANGE_FILES: dict[str, Range] = {
    "NPY": RASTERS["NPY depth"],
    "NPZ": (XYZ["NPZ"], {}),
    "TIFF": RASTERS["TIFF depth"],
    "PNG": RASTERS["PNG"],
    "PGM": RASTERS["PGM"],
    "PFM": RASTERS["PFM little"],
    "OpenEXR": RASTERS["EXR float"],
    "PLY": (XYZ["PLY"], {}),
    "PCD": (XYZ["PCD binary"], {}),
    "PDS3": (XYZ["PDS XYZ attached"], {}),
    "PDS4": (_pds4, {}),
    "IMP table": (XYZ["IMP table"], {}),
}


PLAIN = test_camera_formats.PLAIN
CAHV = {"C": (0.0, 0.0, 0.0), "A": (0.0, 0.0, 1.0)}
CAHV |= {"H": (500.0, 0.0, 159.5), "V": (0.0, 501.0, 119.5)}
SQUARE = dict(CAMERA) | {"fy": 501.0}
CAMERA_FILES: dict[str, scene_files.Make] = {
    "pinhole JSON": lambda f: scene_files.written(f / "c.json", SQUARE),
    "BOP scene_camera": PLAIN["BOP"],
    "OpenCV": PLAIN["OpenCV YAML"],
    "ROS camera_info": PLAIN["ROS"],
    "Open3D": PLAIN["Open3D"],
    "nerfstudio": PLAIN["nerfstudio"],
    "COLMAP": PLAIN["COLMAP"],
    "RealSense": PLAIN["RealSense"],
    "Middlebury": PLAIN["Middlebury"],
    "PDS3": lambda f: pds3_product(
        f / "c.img",
        sphere_scene().depth_m,
        map_type="RANGE_MAP",
        missing="0.0",
        cahv=list(CAHV.values()),
    ),
    "PDS4": lambda f: pds4_label(f / "c.xml", "CAHV", CAHV),
}


def _of(registry: FormatRegistry) -> set[str]:
    return {each.name for each in registry.own if each.readable}


def agree(found: pd.DataFrame, expected: pd.DataFrame) -> None:
    """All numbers of the rows are equal to 0.5 %, whatever the rocks' ids."""
    assert len(found) == len(expected) > 0
    assert list(found.columns) == list(expected.columns)
    numbers = expected.select_dtypes("number").columns.drop("rock")
    assert len(numbers) > 15
    assert expected[numbers].notna().any(axis=0).sum() > 15
    for name in numbers:
        np.testing.assert_allclose(found[name], expected[name], rtol=TOLERANCE, err_msg=name)


def in_order(frame: pd.DataFrame) -> pd.DataFrame:
    return frame.sort_values(["row", "col"], ignore_index=True)


def test_every_format_has_a_file_here() -> None:
    assert set(scene_files.IMAGES) == _of(IMAGES)
    assert set(scene_files.LABELS) == _of(LABELS)
    assert set(RANGE_FILES) == _of(RANGES)
    assert set(CAMERA_FILES) == _of(CAMERAS)
    kinds = (IMAGES, LABELS, RANGES, CAMERAS)
    assert sum(len(_of(each)) for each in kinds) >= FEWEST_FORMATS


def found_in(path: Path) -> pd.DataFrame:
    frame = rockshape.read(path)
    return in_order(rockshape.measure(frame, find="image", descriptors=True).to_frame())


@pytest.mark.parametrize("name", scene_files.IMAGES)
def test_images(tmp_path: Path, name: str) -> None:
    path = scene_files.IMAGES[name](tmp_path)
    pixels = scene_files.picture()
    if name == "JPEG":
        pixels = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
    cv2.imwrite(str(tmp_path / "plain.png"), pixels)
    expected = found_in(tmp_path / "plain.png")
    assert len(expected) == 3
    agree(found_in(path), expected)


def of_labels(folder: Path, path: Path) -> pd.DataFrame:
    cv2.imwrite(str(folder / "i.png"), scene_files.picture())
    frame = rockshape.read(folder / "i.png", labels=path)
    return in_order(rockshape.measure(frame, descriptors=True).to_frame())


@pytest.mark.parametrize("name", scene_files.LABELS)
def test_labels(tmp_path: Path, name: str) -> None:
    np.save(tmp_path / "plain.npy", scene_files.label_image())
    expected = of_labels(tmp_path, tmp_path / "plain.npy")
    if name == "ImageJ ROI":  # the first rock alone
        expected = expected[expected["rock"] == 3].reset_index(drop=True)
    agree(of_labels(tmp_path, scene_files.LABELS[name](tmp_path)), expected)


def as_npy(name: str) -> np.ndarray:
    """Depth or points of the scene as precisely as the format holds them."""
    scene = sphere_scene()
    if name in ("PNG", "PGM"):
        return range_files.holed(range_files.steps(scene) * STEP_M, np.nan)
    points = np.round(scene.points_m.astype(np.float64), DECIMALS if name == "IMP table" else 9)
    return range_files.holed(points, np.nan)


@pytest.mark.parametrize("name", RANGE_FILES)
def test_range(tmp_path: Path, name: str) -> None:
    make, scale = RANGE_FILES[name]
    camera = tmp_path / "camera.json"
    camera.write_text(json.dumps(CAMERA | dict(scale)))
    np.save(tmp_path / "plain.npy", as_npy(name))
    expected = measure_files(tmp_path, range=tmp_path / "plain.npy", camera=camera).to_frame()
    assert expected["sphericity_3d"].notna().all()
    found = measure_files(tmp_path, range=make(tmp_path, sphere_scene()), camera=camera)
    agree(found.to_frame(), expected)


@pytest.mark.parametrize("name", CAMERA_FILES)
def test_cameras(tmp_path: Path, name: str) -> None:
    scene = sphere_scene()
    rays = np.stack([(np.arange(320) - 159.5) / 500 + np.zeros((240, 1)),
                     ((np.arange(240) - 119.5) / 501)[:, None] + np.zeros(320),
                     np.ones((240, 320))], axis=-1)  # fmt: skip
    np.save(tmp_path / "xyz.npy", rays * scene.depth_m[..., None])
    np.save(tmp_path / "depth.npy", scene.depth_m)
    scene_files.written(tmp_path / "plain.json", SQUARE)
    expected = measure_files(
        tmp_path, range=tmp_path / "xyz.npy", camera=tmp_path / "plain.json"
    ).to_frame()
    found = measure_files(
        tmp_path, range=tmp_path / "depth.npy", camera=CAMERA_FILES[name](tmp_path)
    )
    agree(found.to_frame(), expected)
