"""Range with zeros, infinities and constants for no point, in every format, m and mm."""

from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pypcd4
import pytest
import tifffile
import trimesh

from rockshape.errors import InputError
from rockshape.io import read_camera, read_points
from tests.rockshape.io.archive_products import imp_table
from tests.rockshape.io.exr_file import ZIPS, exr
from tests.rockshape.io.scene_files import saved, written
from tests.rockshape.io.sphere_scene import CAMERA, sphere_scene
from tests.rockshape.io.test_range_formats import pds3, pfm

Save = Callable[[Path, np.ndarray], Path]
HOLE = np.s_[100:110, 150:160]
GRID = (240, 320)


def put(path: Path, data: bytes) -> Path:
    path.write_bytes(data)
    return path


def save_pcd(folder: Path, points: np.ndarray) -> Path:
    cloud = pypcd4.PointCloud.from_xyz_points(points.reshape(-1, 3))
    cloud.metadata.width, cloud.metadata.height = GRID[1], GRID[0]
    cloud.save(folder / "z.pcd", encoding=pypcd4.Encoding.BINARY_COMPRESSED)
    return folder / "z.pcd"


POINTS: dict[str, Save] = {
    "NPY": lambda f, v: saved(f / "z.npy", lambda at: np.save(at, v)),
    "NPZ": lambda f, v: saved(f / "z.npz", lambda at: np.savez(at, xyz=v)),
    "TIFF": lambda f, v: saved(
        f / "z.tif", lambda at: tifffile.imwrite(at, v, photometric="rgb", compression="zlib")
    ),
    "PFM": lambda f, v: pfm(f, v, order="<"),
    "EXR": lambda f, v: put(
        f / "z.exr", exr({axis: v[..., k] for k, axis in enumerate("XYZ")}, compression=ZIPS)
    ),
    "PCD": save_pcd,
    "PLY": lambda f, v: saved(f / "z.ply", trimesh.PointCloud(v.reshape(-1, 3)).export),
    "XYZ product": lambda f, v: pds3(f, v, detached=False, constant="(-1.0, -1.0, -1.0)"),
}
DEPTHS: dict[str, Save] = {
    "NPY": POINTS["NPY"],
    "NPZ": lambda f, v: saved(f / "z.npz", lambda at: np.savez_compressed(at, depth=v)),
    "TIFF": lambda f, v: saved(f / "z.tif", lambda at: tifffile.imwrite(at, v)),
    "PFM": POINTS["PFM"],
    "EXR": lambda f, v: put(f / "z.exr", exr({"Z": v}, compression=ZIPS)),
}
STEPS: dict[str, Save] = {
    "NPY": POINTS["NPY"],
    "NPZ": DEPTHS["NPZ"],
    "TIFF": DEPTHS["TIFF"],
    "PNG": lambda f, v: saved(f / "z.png", lambda at: cv2.imwrite(at, v)),
    "PGM": lambda f, v: saved(f / "z.pgm", lambda at: cv2.imwrite(at, v)),
}


def camera_of(folder: Path, **more: float) -> object:
    return read_camera(written(folder / "camera.json", CAMERA | more))


def check(points_m: np.ndarray, atol: float) -> None:
    """The sphere's points, and none in the hole."""
    expected = sphere_scene().points_m.astype(np.float64)
    expected[HOLE] = np.nan
    np.testing.assert_allclose(points_m, expected, atol=atol)


@pytest.mark.parametrize("name", POINTS)
@pytest.mark.parametrize("none", [0.0, np.nan, np.inf, -32768.0, 65535.0])
def test_points_that_are_none(tmp_path: Path, name: str, none: float) -> None:
    points = np.array(sphere_scene().points_m)
    points[HOLE] = none
    path = POINTS[name](tmp_path, points)
    check(read_points(path, shape=GRID, camera=None, kind="xyz").points_m, 1e-5)


@pytest.mark.parametrize("name", DEPTHS)
@pytest.mark.parametrize("none", [0.0, np.inf, -1.0, -9999.0, 65.535, 1e10])
def test_depth_that_is_none(tmp_path: Path, name: str, none: float) -> None:
    depth = np.array(sphere_scene().depth_m)
    depth[HOLE] = none
    reading = read_points(DEPTHS[name](tmp_path, depth), shape=GRID, camera=camera_of(tmp_path))
    check(reading.points_m, 1e-5)
    assert sum(reading.left_out.values()) == 100


@pytest.mark.parametrize("name", STEPS)
@pytest.mark.parametrize("none", [0, 65535])
def test_steps_that_are_none(tmp_path: Path, name: str, none: int) -> None:
    steps = np.rint(sphere_scene().depth_m * 10_000).astype(np.uint16)
    steps[HOLE] = none
    path = STEPS[name](tmp_path, steps)
    with pytest.raises(InputError, match="expected depth_scale"):
        read_points(path, shape=GRID, camera=camera_of(tmp_path))
    camera = camera_of(tmp_path, depth_scale=0.1)
    check(read_points(path, shape=GRID, camera=camera).points_m, 1e-4)


@pytest.mark.parametrize("name", [*POINTS, "IMP table"])
def test_points_in_millimetres(tmp_path: Path, name: str) -> None:
    points = np.array(sphere_scene().points_m) * np.float32(1000)
    if name == "IMP table":
        path = imp_table(tmp_path / "z.tab", points, labelled=False)
    else:
        path = POINTS[name](tmp_path, points)
    with pytest.raises(InputError, match="--range-unit"):
        read_points(path, shape=GRID, camera=None, kind="xyz")
    found = read_points(path, shape=GRID, camera=None, kind="xyz", unit="mm").points_m
    np.testing.assert_allclose(found, sphere_scene().points_m, atol=1e-5)


@pytest.mark.parametrize("name", DEPTHS)
def test_depth_in_millimetres(tmp_path: Path, name: str) -> None:
    path = DEPTHS[name](tmp_path, np.array(sphere_scene().depth_m) * np.float32(1000))
    camera = camera_of(tmp_path)
    with pytest.raises(InputError, match="--range-unit"):
        read_points(path, shape=GRID, camera=camera)
    found = read_points(path, shape=GRID, camera=camera, unit="mm").points_m
    np.testing.assert_allclose(found, sphere_scene().points_m, atol=1e-5)
