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


SIZELESS = {key: PINHOLE[key] for key in ("fx", "fy", "cx", "cy")}
SCALED = [
    pytest.param(0.5, id="of half the size"),
    pytest.param(2.0, id="of twice the size"),
]


@pytest.mark.parametrize("scale", SCALED)
def test_a_camera_of_another_size_is_refused(tmp_path: Path, scale: float) -> None:
    """Which its principal point alone tells, where the file has no size."""
    path = tmp_path / "camera.json"
    path.write_text(json.dumps({key: scale * value for key, value in SIZELESS.items()}))
    with pytest.raises(InputError, match=r"camera\.json: cx, cy: .*middle of 66 x 49 px, found"):
        read_camera(path, shape=(49, 66))
    k = [scale * 300.0, 0.0, scale * 32.5, 0.0, scale * 300.0, scale * 24.0, 0.0, 0.0, 1.0]
    path.write_text(json.dumps({"0": {"cam_K": k}}))
    with pytest.raises(InputError, match=r"camera\.json: cx, cy: .*middle of 66 x 49 px, found"):
        read_camera(path, shape=(49, 66))


@pytest.mark.parametrize("scale", SCALED)
def test_a_camera_that_tells_its_size_may_look_past_its_middle(
    tmp_path: Path, scale: float
) -> None:
    path = write(tmp_path, cx=scale * 32.5, cy=scale * 24.0)
    assert read_camera(path, shape=(49, 66)).cx == scale * 32.5


@pytest.mark.parametrize("moved", [(-6.0, 4.0), (0.0, -40.0), (-60.0, -40.0), (30.0, 0.0)])
def test_a_camera_without_its_size_may_be_that_of_a_tile(
    tmp_path: Path, moved: tuple[float, float]
) -> None:
    path = tmp_path / "camera.json"
    place = {"cx": 32.5 + moved[0], "cy": 24.0 + moved[1]}
    path.write_text(json.dumps(SIZELESS | place))
    assert read_camera(path, shape=(49, 66)).cx == place["cx"]
