"""Camera formats, from the writers that they belong to or transcribed from their specification."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from rockshape.camera.camera import Camera
from rockshape.camera.distortion import BrownConrady, Fisheye, InverseBrownConrady
from rockshape.camera.lens import Lens
from rockshape.errors import InputError
from rockshape.io import read_camera, read_lens, read_points

PINHOLE = Camera(fx=500.0, fy=501.0, cx=159.5, cy=119.5, width=320, height=240)
K = [[500.0, 0.0, 159.5], [0.0, 501.0, 119.5], [0.0, 0.0, 1.0]]
TERMS = (-0.2, 0.05, 0.001, -0.002, 0.01)


def written(folder: Path, name: str, content: object) -> Path:
    path = folder / name
    path.write_text(content if isinstance(content, str) else json.dumps(content))
    return path


def stored(path: Path, **entries: object) -> Path:
    """A file that OpenCV's FileStorage writes."""
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    for name, value in entries.items():
        storage.write(name, value)
    storage.release()
    return path


# As sensor_msgs/CameraInfo is written by ROS's camera_calibration (camera_calibration_parsers).
ROS = """image_width: 320
image_height: 240
camera_name: narrow_stereo
camera_matrix:
  rows: 3
  cols: 3
  data: [500., 0., 159.5, 0., 501., 119.5, 0., 0., 1.]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [{terms}]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1., 0., 0., 0., 1., 0., 0., 0., 1.]
projection_matrix:
  rows: 3
  cols: 4
  data: [500., 0., 159.5, {shift}, 0., 501., 119.5, 0., 0., 0., 1., 0.]
"""
# As `ros2 topic echo` prints the message.
ROS_MESSAGE = """header:
  frame_id: camera
height: 240
width: 320
distortion_model: plumb_bob
d: [0.0, 0.0, 0.0, 0.0, 0.0]
k: [500.0, 0.0, 159.5, 0.0, 501.0, 119.5, 0.0, 0.0, 1.0]
p: [500.0, 0.0, 159.5, 0.0, 0.0, 501.0, 119.5, 0.0, 0.0, 0.0, 1.0, 0.0]
binning_x: 0
binning_y: 0
roi: {x_offset: 0, y_offset: 0, height: 0, width: 0, do_rectify: false}
"""
# As COLMAP's doc/format.rst has cameras.txt; its first pixel's centre is (0.5, 0.5).
COLMAP = """# Camera list with one line of data per camera:
#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]
# Number of cameras: 1
1 PINHOLE 320 240 500 501 160 120
"""
# As Open3D's PinholeCameraIntrinsic::ConvertToJsonValue has it, the matrix by columns.
OPEN3D = {"width": 320, "height": 240, "intrinsic_matrix": np.transpose(K).ravel().tolist()}
# As nerfstudio's docs/quickstart/data_conventions.md has it.
NERFSTUDIO = {
    "camera_model": "OPENCV",
    "fl_x": 500.0,
    "fl_y": 501.0,
    "cx": 160.0,
    "cy": 120.0,
    "w": 320,
    "h": 240,
    "k1": 0.0,
    "k2": 0.0,
    "p1": 0.0,
    "p2": 0.0,
    "frames": [{"file_path": "images/frame_00001.jpeg", "transform_matrix": np.eye(4).tolist()}],
}
# The fields of librealsense's rs2_intrinsics, as its Python wrapper names them.
REALSENSE = {
    "width": 320,
    "height": 240,
    "ppx": 159.5,
    "ppy": 119.5,
    "fx": 500.0,
    "fy": 501.0,
    "model": "distortion.inverse_brown_conrady",
    "coeffs": [0.0, 0.0, 0.0, 0.0, 0.0],
}
# As Middlebury's stereo evaluation 3 describes calib.txt.
MIDDLEBURY = """cam0=[500 0 159.5; 0 501 119.5; 0 0 1]
cam1=[500 0 165.5; 0 501 119.5; 0 0 1]
doffs=6
baseline=193.001
width=320
height=240
ndisp=64
"""
# As BOP's toolkit describes scene_camera.json.
BOP = {"0": {"cam_K": np.ravel(K).tolist(), "depth_scale": 0.1}}
PLAIN = {
    "OpenCV YAML": lambda folder: stored(
        folder / "camera.yml",
        image_width=320,
        image_height=240,
        camera_matrix=np.array(K),
        distortion_coefficients=np.zeros((1, 5)),
    ),
    "OpenCV JSON": lambda folder: stored(
        folder / "camera.json", image_width=320, image_height=240, camera_matrix=np.array(K)
    ),
    "OpenCV XML": lambda folder: stored(folder / "camera.xml", cameraMatrix=np.array(K)),
    "ROS": lambda folder: written(
        folder, "camera.yaml", ROS.format(terms="0., 0., 0., 0., 0.", shift="0.")
    ),
    "ROS message": lambda folder: written(folder, "camera.yaml", ROS_MESSAGE),
    "COLMAP": lambda folder: written(folder, "cameras.txt", COLMAP),
    "Open3D": lambda folder: written(folder, "camera.json", OPEN3D),
    "Open3D parameters": lambda folder: written(
        folder, "camera.json", {"class_name": "PinholeCameraParameters", "intrinsic": OPEN3D}
    ),
    "nerfstudio": lambda folder: written(folder, "transforms.json", NERFSTUDIO),
    "RealSense": lambda folder: written(folder, "camera.json", REALSENSE),
    "Middlebury": lambda folder: written(folder, "calib.txt", MIDDLEBURY),
    "BOP": lambda folder: written(folder, "scene_camera.json", BOP),
    "byte order mark": lambda folder: written(folder, "camera.json", "\ufeff" + json.dumps(OPEN3D)),
}


@pytest.mark.parametrize("make", PLAIN.values(), ids=PLAIN.keys())
@pytest.mark.parametrize("suffix", [None, ".dat"], ids=["by name", "by content"])
def test_the_same_pinhole_of_every_format(
    tmp_path: Path, make: Callable[[Path], Path], suffix: str | None
) -> None:
    path = make(tmp_path)
    if suffix is not None:
        path = path.rename(path.with_suffix(suffix))
    lens = read_lens(path, shape=(240, 320))
    assert lens.is_pinhole
    found = lens.pinhole
    assert (found.fx, found.fy, found.cx, found.cy) == (500, 501, 159.5, 119.5)
    assert found.shape == (240, 320)
    assert read_camera(path, shape=(240, 320)) == found


BENT = {
    "pinhole JSON": (
        lambda folder: written(
            folder,
            "c.json",
            {"fx": 500, "fy": 501, "cx": 159.5, "cy": 119.5, "distortion": list(TERMS)},
        ),
        BrownConrady(TERMS),
    ),
    "OpenCV": (
        lambda folder: stored(
            folder / "c.yml", K=np.array(K), distCoeffs=np.array([TERMS]), imageSize=(320, 240)
        ),
        BrownConrady(TERMS),
    ),
    "OpenCV fisheye": (
        lambda folder: stored(
            folder / "c.yml",
            camera_matrix=np.array(K),
            distortion_coefficients=np.array([TERMS[:4]]).T,
            fisheye_model=1,
        ),
        Fisheye(TERMS[:4]),
    ),
    "ROS": (
        lambda folder: written(
            folder, "c.yaml", ROS.format(terms=", ".join(map(str, TERMS)), shift="0.")
        ),
        BrownConrady(TERMS),
    ),
    "ROS fisheye": (
        lambda folder: written(
            folder,
            "c.yaml",
            ROS.format(terms=", ".join(map(str, TERMS[:4])), shift="0.").replace(
                "plumb_bob", "equidistant"
            ),
        ),
        Fisheye(TERMS[:4]),
    ),
    "COLMAP": (
        lambda folder: written(
            folder, "c.txt", "3 OPENCV 320 240 500 501 160 120 -0.2 0.05 0.001 -0.002\n"
        ),
        BrownConrady(TERMS[:4]),
    ),
    "COLMAP fisheye": (
        lambda folder: written(
            folder, "c.txt", "3 OPENCV_FISHEYE 320 240 500 501 160 120 -0.2 0.05 0.001 -0.002\n"
        ),
        Fisheye(TERMS[:4]),
    ),
    "nerfstudio": (
        lambda folder: written(
            folder,
            "c.json",
            NERFSTUDIO | dict(zip(("k1", "k2", "p1", "p2", "k3"), TERMS, strict=True)),
        ),
        BrownConrady(TERMS),
    ),
    "RealSense": (
        lambda folder: written(folder, "c.json", REALSENSE | {"coeffs": list(TERMS)}),
        InverseBrownConrady(TERMS),
    ),
    "RealSense colour": (
        lambda folder: written(folder, "c.json", REALSENSE | {"coeffs": TERMS, "model": 4}),
        BrownConrady(TERMS),
    ),
}


@pytest.mark.parametrize(("make", "distortion"), BENT.values(), ids=BENT.keys())
def test_distortion_is_read_and_no_pinhole(
    tmp_path: Path, make: Callable[[Path], Path], distortion: object
) -> None:
    path = make(tmp_path)
    lens = read_lens(path, shape=(240, 320))
    assert lens.distortion == distortion
    assert (lens.pinhole.fx, lens.pinhole.cx) == (500, 159.5)
    with pytest.raises(InputError, match="distortion: expected a pinhole camera"):
        read_camera(path, shape=(240, 320))


def test_rays_project_to_their_own_pixels(tmp_path: Path) -> None:
    lens = read_lens(BENT["OpenCV"][0](tmp_path), shape=(240, 320))
    skewed = Lens(lens.pinhole, skew_px=7.0, distortion=lens.distortion)
    rows, cols = np.mgrid[:240, :320]
    np.testing.assert_allclose(skewed.project(skewed.rays()), np.dstack([cols, rows]), atol=1e-4)


def test_skew_is_read_from_a_matrix(tmp_path: Path) -> None:
    skewed = np.array(K)
    skewed[0, 1] = 3.5
    lens = read_lens(stored(tmp_path / "c.yml", K=skewed), shape=(240, 320))
    assert lens.skew_px == 3.5
    with pytest.raises(InputError, match=r"skew 3\.5 px"):
        read_camera(tmp_path / "c.yml", shape=(240, 320))


def view(focal: float) -> dict[str, object]:
    return {"cam_K": [focal, 0, 159.5, 0, focal, 119.5, 0, 0, 1], "depth_scale": 1.0}


@pytest.mark.parametrize(
    ("chosen", "image", "focal"),
    [("3", "", 530), (None, "000003.png", 530), ("12", "000003.png", 512), (None, "12.tif", 512)],
)
def test_a_view_of_a_scene_is_named_or_the_images(
    tmp_path: Path, chosen: str | None, image: str, focal: float
) -> None:
    path = written(tmp_path, "scene_camera.json", {"3": view(530), "12": view(512)})
    lens = read_lens(path, shape=(240, 320), image_name=image, view=chosen)
    assert lens.pinhole.fx == focal


def test_a_view_that_is_open_is_asked_for(tmp_path: Path) -> None:
    path = written(tmp_path, "scene_camera.json", {"3": view(530), "12": view(512)})
    with pytest.raises(InputError, match=r"json: expected --camera-view with one of 3, 12, found"):
        read_lens(path, shape=(240, 320), image_name="photo.png")
    with pytest.raises(InputError, match=r"expected --camera-view to be one of 3, 12, found '4'"):
        read_lens(path, shape=(240, 320), view="4")
    same = written(tmp_path, "scene_camera.json", {"3": view(530), "12": view(530)})
    assert read_lens(same, shape=(240, 320)).pinhole.fx == 530


def test_colmap_chooses_by_the_cameras_id(tmp_path: Path) -> None:
    path = written(tmp_path, "cameras.txt", COLMAP + "2 SIMPLE_PINHOLE 320 240 600 160 120\n")
    assert read_lens(path, shape=(240, 320), view="2").pinhole.fx == 600
    with pytest.raises(InputError, match="one of 1, 2"):
        read_lens(path, shape=(240, 320))


def test_nerfstudio_frames_can_have_their_own_camera(tmp_path: Path) -> None:
    frames = [
        {"file_path": f"images/{name}.png", "fl_x": focal, "fl_y": focal}
        for name, focal in (("a", 510.0), ("b", 520.0))
    ]
    path = written(tmp_path, "transforms.json", NERFSTUDIO | {"frames": frames})
    assert read_lens(path, shape=(240, 320), image_name="b.png").pinhole.fx == 520


def test_the_field_of_view_gives_the_focal_length(tmp_path: Path) -> None:
    path = written(
        tmp_path, "transforms.json", {"camera_angle_x": 2 * np.arctan(160 / 500), "frames": []}
    )
    found = read_lens(path, shape=(240, 320)).pinhole
    assert (found.fx, found.cx, found.cy) == (pytest.approx(500), 159.5, 119.5)


# Z = 500 px * 0.193001 m / (d + 6 px), see OpenCV's stereoRectify
Q = np.array([[1, 0, 0, -159.5], [0, 1, 0, -119.5], [0, 0, 0, 500], [0, 0, 1, 6]], dtype=np.float64)
Q[3] /= 0.193001
BASELINES = {
    "pinhole JSON": lambda folder: written(
        folder,
        "c.json",
        {"fx": 500, "fy": 500, "cx": 159.5, "cy": 119.5, "baseline_m": 0.193001}
        | {"disparity_offset": 6},
    ),
    "Middlebury": lambda folder: written(folder, "calib.txt", MIDDLEBURY.replace("501", "500")),
    "OpenCV Q": lambda folder: stored(folder / "q.yml", Q=Q),
}


@pytest.mark.parametrize("make", BASELINES.values(), ids=BASELINES.keys())
def test_disparity_becomes_the_points_that_opencv_makes_of_it(
    tmp_path: Path, make: Callable[[Path], Path]
) -> None:
    disparity = np.random.default_rng(5).uniform(20, 60, (240, 320)).astype(np.float32)
    disparity[:9] = 0
    np.save(tmp_path / "d.npy", disparity)
    camera = read_lens(make(tmp_path), shape=(240, 320))
    expected = cv2.reprojectImageTo3D(disparity, Q)
    expected[:9] = np.nan
    for values, scale in ((disparity, 1.0), (np.rint(16 * disparity).astype(np.int16), 1 / 16)):
        np.save(tmp_path / "d.npy", values)
        stepped = replace(camera, disparity=replace(camera.disparity, step_px=scale))
        points = read_points(
            tmp_path / "d.npy", shape=(240, 320), camera=stepped, kind="disparity"
        ).points_m
        np.testing.assert_allclose(points, expected, rtol=1e-5 if scale == 1 else 2e-3)
    with pytest.raises(InputError, match="disparity in whole steps: expected disparity_scale"):
        read_points(tmp_path / "d.npy", shape=(240, 320), camera=camera, kind="disparity")


def test_the_baseline_of_a_right_camera_in_ros(tmp_path: Path) -> None:
    text = ROS.format(terms="0., 0., 0., 0., 0.", shift="-60.0")
    lens = read_lens(written(tmp_path, "right.yaml", text), shape=(240, 320))
    assert lens.disparity is not None
    assert lens.disparity.baseline_m == pytest.approx(0.12)


STORED = """%YAML:1.0
---
M1: !!opencv-matrix
   rows: 3
   cols: {cols}
   dt: d
   data: [ 500., 0., {cx}, 0., 501., 119.5, 0., 0., 1. ]
"""
WRONG = [
    ("c.yml", STORED.format(cols=300000, cx=159.5), "cannot reshape array of size 9"),
    ("c.yml", STORED.format(cols=-3, cx=159.5), "cannot reshape array of size 9"),
    ("c.yml", STORED.format(cols="three", cx=159.5), "a matrix with other than numbers"),
    ("c.yml", STORED.format(cols=3, cx="far"), "a matrix with other than numbers"),
    ("c.json", {**REALSENSE, "width": 640}, r"expected \(240, 320\) as the image has, found \(2"),
    ("c.json", {**REALSENSE, "fx": -500.0}, "fx: expected a positive number, found -500"),
    ("c.json", {**REALSENSE, "fx": 1e300}, "fx: expected at most 1e"),
    ("c.json", {**REALSENSE, "height": -240}, "height: expected a positive number"),
    ("c.json", {**REALSENSE, "coeffs": [0.1] * 20}, "distortion: expected at most 14 terms"),
    ("c.json", {**REALSENSE, "model": "ftheta", "coeffs": [0.1]}, "found ftheta"),
    ("c.json", {**REALSENSE, "model": "magic"}, "model: expected one of none"),
    ("c.json", {**OPEN3D, "intrinsic_matrix": [1.0] * 8}, "intrinsic_matrix: expected 3 x 3"),
    ("c.json", {**OPEN3D, "intrinsic_matrix": [1.0] * 9}, "intrinsic matrix: expected"),
    ("c.json", {**NERFSTUDIO, "camera_model": "EQUIRECTANGULAR"}, "camera_model: expected OPENCV"),
    ("c.json", {"0": {"cam_K": [1, 2]}}, "intrinsic matrix: expected 3 x 3 finite numbers"),
    ("c.yaml", ROS.format(terms=".nan", shift="0"), "distortion: expected finite numbers"),
    ("c.yaml", ROS_MESSAGE.replace("plumb_bob", "thin_prism"), "distortion_model: expected plumb"),
    ("c.yaml", ROS_MESSAGE.replace("binning_x: 0", "binning_x: 2"), "without binning"),
    ("c.yaml", "camera_matrix: [1, 2", "expected a camera"),
    ("c.yml", "%YAML:1.0\n---\nname: !!opencv-matrix\n", "expected a camera"),
    ("c.txt", "1 THIN_PRISM_FISHEYE 320 240 1 2 3 4 5 6 7 8 9 9 9 9", "THIN_PRISM_FISHEYE"),
    ("c.txt", "1 PINHOLE 320 240 500 501 160", "PINHOLE: expected 4 parameters, found 3"),
    ("c.txt", MIDDLEBURY.replace("193.001", "far"), "expected numbers"),
    ("c.txt", MIDDLEBURY.replace("193.001", "nan"), "baseline_m: expected a positive number"),
    ("c.json", {"fx": 5, "fy": 5, "cx": 1, "cy": 1, "disparity_scale": 1}, "baseline_m: expected"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "content", "says"), WRONG, ids=[says for *_, says in WRONG])
def test_what_is_no_camera_is_one_line(
    tmp_path: Path, name: str, content: object, says: str
) -> None:
    path = written(tmp_path, name, content)
    with pytest.raises(InputError, match=says) as refused:
        read_lens(path, shape=(240, 320))
    assert str(refused.value).startswith(str(path))
    assert "\n" not in str(refused.value)
