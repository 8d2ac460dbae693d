"""A sphere in whole millimetres, and a tile of a picture with the camera of the whole."""

import json
from pathlib import Path

import cv2
import numpy as np
import pytest

import rockshape
from rockshape.errors import InputError
from rockshape.io import read_lens
from tests.rockshape.io.sphere_scene import CAMERA, RADIUS_M, measure_files, sphere_scene

TILE = np.s_[150:162, 150:162]


@pytest.mark.parametrize("step_mm", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("hole", [None, 0, 65535])
def test_the_ellipsoid_error_of_a_sphere_in_steps_is_that_of_rounding(
    tmp_path: Path, step_mm: float, hole: int | None
) -> None:
    scene = sphere_scene()
    steps = np.rint(scene.depth_m / (step_mm / 1000)).astype(np.uint16)
    if hole is not None:
        steps[118:128, 158:168] = hole
    cv2.imwrite(str(tmp_path / "z.png"), steps)
    (tmp_path / "camera.json").write_text(json.dumps(CAMERA | {"depth_scale": step_mm}))
    rock = measure_files(tmp_path, range=tmp_path / "z.png",
                         camera=tmp_path / "camera.json").rocks[0]  # fmt: skip
    # Rounding to q is off by q/√12 RMS along the ray, of which the normal's share n_z shows as
    # distance from the sphere; over the pixels of a disc n_z² is even from 0 to 1, ½ on average.
    expected = step_mm / 1000 / np.sqrt(12) * np.sqrt(1 / 2) / RADIUS_M  # 1.36e-3 at 1 mm
    assert rock.readings["ellipsoid_error"].value == pytest.approx(expected, rel=0.15)


def tile_files(folder: Path, camera: dict[str, float]) -> dict[str, Path]:
    scene = sphere_scene()
    labels = np.zeros((12, 12), np.uint8)
    labels[2:10, 2:10] = 1
    cv2.imwrite(str(folder / "tile.png"), scene.image[TILE])
    cv2.imwrite(str(folder / "labels.png"), labels)
    np.save(folder / "tile.npy", scene.depth_m[TILE])
    (folder / "camera.json").write_text(json.dumps(camera))
    return {"range": folder / "tile.npy", "labels": folder / "labels.png"}


def test_the_camera_of_a_whole_picture_is_none_of_its_tile(tmp_path: Path) -> None:
    files = tile_files(tmp_path, CAMERA)
    with pytest.raises(InputError) as refused:
        rockshape.read(tmp_path / "tile.png", camera=tmp_path / "camera.json", **files)
    assert str(refused.value) == (
        f"{tmp_path / 'camera.json'}: camera: expected (12, 12) as the image has, found "
        f"(240, 320): another image's, or of one before it was cropped or scaled"
    )
    with pytest.raises(InputError, match="before it was cropped or scaled"):
        read_lens(tmp_path / "camera.json", shape=(12, 12))


@pytest.mark.parametrize("method", ["paper", "robust"])
def test_a_tile_with_too_little_ground_has_reasons(tmp_path: Path, method: str) -> None:
    camera = {"fx": 500.0, "fy": 500.0, "cx": 159.5 - 150, "cy": 119.5 - 150}  # without a size
    files = tile_files(tmp_path, camera)
    observation = rockshape.read(tmp_path / "tile.png", camera=tmp_path / "camera.json", **files)
    (rock,) = rockshape.measure(observation, method=method)
    solid = [rock.readings[name] for name in rock.readings if name.endswith("3d")]
    assert solid
    assert all(
        np.isfinite(each.value) or each.reason is not None for each in rock.readings.values()
    )
    assert any(each.reason is not None for each in solid)
