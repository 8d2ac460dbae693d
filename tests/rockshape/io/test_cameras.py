"""Camera files read, and say which key is wrong."""

import json
from pathlib import Path

import pytest

from rockshape.camera.camera import Camera
from rockshape.errors import InputError
from rockshape.io import read_camera

PINHOLE = {"fx": 300.0, "fy": 301.0, "cx": 32.5, "cy": 24.0, "width": 66, "height": 49}


def write(folder: Path, **more: object) -> Path:
    path = folder / "camera.json"
    path.write_text(json.dumps(PINHOLE | more))
    return path


def test_other_keys_are_passed_over(tmp_path: Path) -> None:
    assert read_camera(write(tmp_path, maker="anyone")) == Camera(**PINHOLE)


@pytest.mark.parametrize("none", [None, [], [0.0, 0.0, 0.0, 0.0]])
def test_a_lens_that_bends_nothing_is_a_pinhole(tmp_path: Path, none: object) -> None:
    assert read_camera(write(tmp_path, distortion=none)) == Camera(**PINHOLE)


def test_a_lens_that_bends_rays_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"camera\.json: distortion: .*undistorted"):
        read_camera(write(tmp_path, distortion=[-0.2, 0.05, 0.0, 0.0]))


def test_a_missing_key_is_named(tmp_path: Path) -> None:
    path = tmp_path / "camera.json"
    path.write_text(json.dumps({key: value for key, value in PINHOLE.items() if key != "fy"}))
    with pytest.raises(InputError, match="fy"):
        read_camera(path)
