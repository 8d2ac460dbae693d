"""Range readers: z-depth and points, in metres, through each format."""

from pathlib import Path

import cv2
import numpy as np
import pytest
import tifffile

from rockshape.camera.camera import Camera
from rockshape.errors import InputError
from rockshape.io import read_range
from tests import solids


@pytest.mark.parametrize("ending", ["npy", "npz", "tif"])
def test_depth_becomes_points_through_the_camera(tmp_path: Path, ending: str) -> None:
    camera = solids.CAMERA
    depth = np.full(camera.shape, 2.5, dtype=np.float32)
    depth[0, 0] = 0
    depth[0, 1] = np.nan
    path = tmp_path / f"depth.{ending}"
    match ending:
        case "npy":
            np.save(path, depth)
        case "npz":
            np.savez(path, depth=depth)
        case _:
            tifffile.imwrite(path, depth)
    points = read_range(path, shape=camera.shape, camera=camera)
    assert np.isnan(points[0, :2]).all()
    assert camera.project(points[1, 5]) == pytest.approx([5, 1])
    assert points[1, 5, 2] == 2.5


def test_a_point_known_in_part_is_not_known(tmp_path: Path) -> None:
    points = np.ones((2, 2, 3))
    points[0, 1, 2] = np.inf
    path = tmp_path / "range.npy"
    np.save(path, points)
    read = read_range(path, shape=(2, 2), camera=None)
    assert np.isnan(read[0, 1]).all()
    assert np.isfinite(read[1]).all()


def test_png_depth_is_in_the_cameras_steps(tmp_path: Path) -> None:
    path = tmp_path / "depth.png"
    cv2.imwrite(str(path), np.array([[0, 4000], [8000, 12000]], dtype=np.uint16))
    camera = Camera(fx=2.0, fy=2.0, cx=0.5, cy=0.5, width=2, height=2, depth_scale=0.25)
    points = read_range(path, shape=(2, 2), camera=camera)
    assert np.isnan(points[0, 0]).all()
    # 4000 steps of 0.25 mm
    np.testing.assert_allclose(points[..., 2].ravel()[1:], [1, 2, 3])
    np.testing.assert_allclose(points[0, 1], [0.25, -0.25, 1])


@pytest.mark.parametrize(
    ("scale", "says"), [(None, "expected depth_scale"), ("none", "expected a camera")]
)
def test_png_depth_needs_the_size_of_a_step(tmp_path: Path, scale: object, says: str) -> None:
    path = tmp_path / "depth.png"
    cv2.imwrite(str(path), np.full((2, 2), 900, dtype=np.uint16))
    camera = Camera(fx=2.0, fy=2.0, cx=0.5, cy=0.5, width=2, height=2) if scale is None else None
    with pytest.raises(InputError, match=rf"depth\.png: range in whole steps: {says}"):
        read_range(path, shape=(2, 2), camera=camera)


def test_a_ply_of_another_number_of_vertices_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "range.ply"
    lines = ["ply", "format ascii 1.0", "element vertex 3"]
    lines += [f"property float {axis}" for axis in "xyz"] + [
        "end_header",
        "0 0 1",
        "1 0 1",
        "0 1 1",
    ]
    path.write_text("\n".join(lines) + "\n")
    with pytest.raises(InputError, match="a vertex for each of 2 x 2 pixels, found 3"):
        read_range(path, shape=(2, 2), camera=None)
    points = read_range(path, shape=(1, 3), camera=None)
    np.testing.assert_array_equal(points, [[[0, 0, 1], [1, 0, 1], [0, 1, 1]]])
