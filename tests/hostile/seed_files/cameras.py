"""Camera files of the scene's camera, without and with distortion."""

from collections.abc import Iterator

import cv2
import numpy as np

from tests.hostile.scene import CAMERA
from tests.hostile.seed_files.encoding import File, as_json, pds4
from tests.hostile.seed_files.ranges import BASELINE_M, DISPARITY_STEP_PX

K = np.array([[80.0, 0.0, 32.0], [0.0, 80.0, 24.0], [0.0, 0.0, 1.0]])
SIZE = {"width": 64, "height": 48}
TERMS = [-0.1, 0.01, 0.001, -0.001, 0.0]
ROS = """image_width: 64
image_height: 48
camera_matrix: {rows: 3, cols: 3, data: [80.0, 0.0, 32.0, 0.0, 80.0, 24.0, 0.0, 0.0, 1.0]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [-0.1, 0.01, 0.001, -0.001, 0.0]}
projection_matrix:
  rows: 3
  cols: 4
  data: [80.0, 0.0, 32.0, -8.0, 0.0, 80.0, 24.0, 0.0, 0.0, 0.0, 1.0, 0.0]
"""
ROS_MESSAGE = """height: 48
width: 64
distortion_model: equidistant
d: [0.01, 0.0, 0.0, 0.0]
k: [80.0, 0.0, 32.0, 0.0, 80.0, 24.0, 0.0, 0.0, 1.0]
roi: {x_offset: 0, y_offset: 0, height: 0, width: 0, do_rectify: false}
"""
COLMAP = "# Camera list\n1 PINHOLE 64 48 80 80 32.5 24.5\n2 OPENCV 64 48 80 80 32 24 -.1 .01 0 0\n"
MIDDLEBURY = """cam0=[80 0 32; 0 80 24; 0 0 1]
cam1=[80 0 33; 0 80 24; 0 0 1]
doffs=1
baseline=100
width=64
height=48
"""


CAHVOR = {
    "C": (0.5, 0.1, -1.2),
    "A": (1.0, 0.0, 0.0),
    "H": (32.0, 80.0, 0.0),
    "V": (24.0, 0.0, 80.0),
    "O": (1.0, 0.0, 0.0),
    "R": (0.01, -0.01, 0.0),
}


def files() -> Iterator[File]:
    """A camera of each format."""
    yield "pinhole JSON", ".json", as_json({**CAMERA, "depth_scale": 1.0})
    disparity = {"baseline_m": BASELINE_M, "disparity_scale": DISPARITY_STEP_PX}
    yield (
        "pinhole JSON",
        ".json",
        as_json({**CAMERA, "skew": 0.5, "distortion": TERMS, **disparity}),
    )
    views = {"3": {"cam_K": K.ravel().tolist(), "depth_scale": 0.1}}
    yield "BOP scene_camera", ".json", as_json(views)
    yield "BOP scene_camera", ".json", as_json(views | {"12": {"cam_K": K.ravel().tolist()}})
    yield from _opencv()
    yield "ROS camera_info", ".yaml", ROS.encode()
    yield "ROS camera_info", ".yaml", ROS_MESSAGE.encode()
    by_columns = {**SIZE, "intrinsic_matrix": K.T.ravel().tolist()}
    yield "Open3D", ".json", as_json(by_columns)
    yield "Open3D", ".json", as_json({"intrinsic": by_columns, "extrinsic": np.eye(4).tolist()})
    frame = {"file_path": "images/scene.png", "transform_matrix": np.eye(4).tolist()}
    focal = {"fl_x": 80.0, "fl_y": 80.0, "cx": 32.5, "cy": 24.5, "w": 64, "h": 48}
    yield "nerfstudio", ".json", as_json({**focal, "k1": -0.1, "frames": [frame]})
    yield "nerfstudio", ".json", as_json({"frames": [frame | focal, frame | focal]})
    yield "COLMAP", ".txt", COLMAP.encode()
    own = {**SIZE, "fx": 80.0, "fy": 80.0, "ppx": 32.0, "ppy": 24.0, "depth_scale": 0.001}
    terms = {"model": "distortion.inverse_brown_conrady", "coeffs": TERMS}
    yield "RealSense", ".json", as_json(own | terms)
    yield "Middlebury", ".txt", MIDDLEBURY.encode()
    yield "PDS3", ".lbl", _pds3()
    yield "PDS4", ".xml", _pds4()


def _pds3() -> bytes:
    """CAHVOR after the MER camera SIS, GEOMETRIC_CAMERA_MODEL."""
    label = [
        "PDS_VERSION_ID = PDS3",
        "RECORD_TYPE = UNDEFINED",
        '^IMAGE = ("hostile.img", 1 <BYTES>)',
        "GROUP = GEOMETRIC_CAMERA_MODEL",
        "  MODEL_TYPE = CAHVOR",
        *(f"  MODEL_COMPONENT_{k} = {vector}" for k, vector in enumerate(CAHVOR.values(), 1)),
        "END_GROUP = GEOMETRIC_CAMERA_MODEL",
        "OBJECT = IMAGE",
        "  LINES = 48",
        "  LINE_SAMPLES = 64",
        "  SAMPLE_TYPE = UNSIGNED_INTEGER",
        "  SAMPLE_BITS = 8",
        "END_OBJECT = IMAGE",
        "END",
    ]
    return ("\r\n".join(label) + "\r\n").encode()


def _pds4() -> bytes:
    """CAHV after the PDS4 geometry dictionary, beside an array."""
    names = {
        "C": ("Center", "position"),
        "A": ("Axis", "unit"),
        "H": ("Horizontal", "pixel"),
        "V": ("Vertical", "pixel"),
    }
    vectors = "".join(
        f"<geom:Vector_{part}>"
        + "".join(
            f"<geom:{axis}_{unit}>{value}</geom:{axis}_{unit}>"
            for axis, value in zip("xyz", CAHVOR[letter], strict=True)
        )
        + f"</geom:Vector_{part}>"
        for letter, (part, unit) in names.items()
    )
    start = b'xmlns="http://pds.nasa.gov/pds4/pds/v1"'
    area = f"<Observation_Area><geom:CAHV_Model>{vectors}</geom:CAHV_Model></Observation_Area>"
    label = pds4(np.zeros((48, 64), np.uint8), data_type="UnsignedByte")
    return label.replace(start, start + b' xmlns:geom="http://pds.nasa.gov/pds4/geom/v1"').replace(
        b"<File_Area_Observational>", area.encode() + b"<File_Area_Observational>"
    )


def _opencv() -> Iterator[File]:
    terms = np.array([TERMS])
    rows = np.array([[1.0, 0, 0, -32], [0, 1, 0, -24], [0, 0, 0, 80], [0, 0, 10, 0]])
    stereo = {"M1": K, "D1": terms, "M2": K, "D2": terms, "R": np.eye(3), "T": np.eye(3)[:, :1]}
    for suffix in (".yml", ".json", ".xml"):
        for entries in (
            {"camera_matrix": K, "distortion_coefficients": terms},
            stereo,
            {"Q": rows},
        ):
            storage = cv2.FileStorage(suffix, cv2.FILE_STORAGE_WRITE | cv2.FILE_STORAGE_MEMORY)
            for name, value in {"image_width": 64, "image_height": 48, **entries}.items():
                storage.write(name, value)
            yield "OpenCV", suffix, storage.releaseAndGetString().encode()
