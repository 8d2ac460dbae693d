"""Range by its meaning: what is no measurement, and units, in every format that can hold them."""

import json
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest
import tifffile

from rockshape.cli import main
from rockshape.errors import InputError
from rockshape.io import read_camera, read_points
from tests.rockshape.io.sphere_scene import CAMERA, RADIUS_M, measure_files, sphere_scene

Write = Callable[[Path, np.ndarray], Path]
SHAPE = (240, 320)
HOLE = np.s_[100:110, 150:160]  # within the sphere


def write_png(folder: Path, steps: np.ndarray) -> Path:
    path = folder / "z.png"
    cv2.imwrite(str(path), steps)
    return path


def write_tiff(folder: Path, values: np.ndarray) -> Path:
    path = folder / "z.tif"
    tifffile.imwrite(path, values, photometric="minisblack")  # points as a page a row
    return path


def write_npy(folder: Path, values: np.ndarray) -> Path:
    path = folder / "z.npy"
    np.save(path, values)
    return path


def write_npz(folder: Path, values: np.ndarray) -> Path:
    path = folder / "z.npz"
    np.savez(path, **{"depth" if values.ndim == 2 else "xyz": values})
    return path


def write_camera(folder: Path, **more: object) -> Path:
    path = folder / "camera.json"
    path.write_text(json.dumps(CAMERA | more))
    return path


def steps_mm(dtype: type = np.uint16) -> np.ndarray:
    return np.rint(sphere_scene().depth_m * 1000).astype(dtype)


WHOLE = {
    "png uint16": (write_png, np.uint16),
    "tiff uint16": (write_tiff, np.uint16),
    "tiff int32": (write_tiff, np.int32),
    "npy uint16": (write_npy, np.uint16),
    "npy int64": (write_npy, np.int64),
    "npz int16": (write_npz, np.int16),
}


@pytest.mark.parametrize(("write", "dtype"), WHOLE.values(), ids=WHOLE.keys())
@pytest.mark.parametrize("scale", [{"depth_scale": 1.0}, {"depth_scale_m": 0.001}], ids=["mm", "m"])
def test_whole_numbers_are_steps_in_every_file_type(
    tmp_path: Path, write: Write, dtype: type, scale: dict[str, float]
) -> None:
    camera = write_camera(tmp_path, **scale)
    steps = steps_mm(dtype)
    reading = read_points(write(tmp_path, steps), shape=SHAPE, camera=read_camera(camera))
    assert reading.left_out == {}
    np.testing.assert_allclose(reading.points_m, sphere_scene().points_m, atol=1.1e-3)
    with pytest.raises(InputError, match=r"z\.\w+: range in whole steps: expected depth_scale"):
        read_points(
            tmp_path / f"z{write(tmp_path, steps).suffix}",
            shape=SHAPE,
            camera=read_camera(write_camera(tmp_path)),
        )


@pytest.mark.parametrize(("write", "dtype"), WHOLE.values(), ids=WHOLE.keys())
@pytest.mark.parametrize(("value", "reason"), [(0, "zero"), (None, "saturated")])
def test_holes_of_whole_numbers_leave_the_sphere_as_it_is(
    tmp_path: Path, write: Write, dtype: type, value: int | None, reason: str
) -> None:
    steps = steps_mm(dtype)
    steps[HOLE] = np.iinfo(dtype).max if value is None else value
    camera = write_camera(tmp_path, depth_scale=1.0)
    measurement = measure_files(tmp_path, range=write(tmp_path, steps), camera=camera)
    assert measurement.observation.left_out == {reason: 100}
    check_sphere(measurement.rocks[0].readings)


FLOATS = {"npy": write_npy, "npz": write_npz, "tiff": write_tiff}


@pytest.mark.parametrize("write", FLOATS.values(), ids=FLOATS.keys())
@pytest.mark.parametrize("none", [0.0, np.nan, np.inf, -9999.0, -1.0, 1e10, 65.535, 65535.0])
@pytest.mark.parametrize("kind", ["depth", "distance", "xyz"])
def test_holes_of_floats_leave_the_sphere_as_it_is(
    tmp_path: Path, write: Write, none: float, kind: str
) -> None:
    if kind == "xyz" and none in (-1.0, 65.535):
        pytest.skip("coordinates may be negative, and far")
    scene = sphere_scene()
    values = {"depth": scene.depth_m, "distance": scene.distance_m, "xyz": scene.points_m}[kind]
    values = values.astype(np.float32)
    values[HOLE] = none
    reading = read_points(
        write(tmp_path, values),
        shape=SHAPE,
        camera=read_camera(write_camera(tmp_path)),
        kind=kind,
    )
    assert sum(reading.left_out.values()) == (0 if np.isnan(none) else 100)
    assert np.isnan(reading.points_m[HOLE]).all()
    expected = scene.points_m.copy()
    expected[HOLE] = np.nan
    np.testing.assert_allclose(reading.points_m, expected, atol=2e-6)


def test_zeros_among_points_without_a_camera_keep_camera_and_sphere(tmp_path: Path) -> None:
    points = sphere_scene().points_m.copy()
    points[::3] = 0
    measurement = measure_files(tmp_path, range=write_npz(tmp_path, points))
    resection = measurement.observation.resection
    assert resection is not None
    assert resection.residual_px < 0.01
    check_sphere(measurement.rocks[0].readings)


def test_a_geotiffs_nodata_tag_is_heeded(tmp_path: Path) -> None:
    depth = sphere_scene().depth_m.copy()
    depth[HOLE] = 7.25
    path = tmp_path / "z.tif"
    # GDAL writes the value as text in the tag 42113
    tifffile.imwrite(path, depth, extratags=[(42113, "s", 0, "7.25", True)])
    reading = read_points(path, shape=SHAPE, camera=read_camera(write_camera(tmp_path)))
    assert reading.left_out == {"no-data value": 100}


@pytest.mark.parametrize(
    "layout",
    [
        {"photometric": "rgb"},
        {"photometric": "rgb", "planarconfig": "separate"},
        {"photometric": "minisblack"},
    ],
)
def test_points_of_a_tiff_in_each_layout(tmp_path: Path, layout: dict[str, str]) -> None:
    points = sphere_scene().points_m
    path = tmp_path / "xyz.tif"
    planes = layout != {"photometric": "rgb"}
    tifffile.imwrite(path, np.moveaxis(points, -1, 0) if planes else points, **layout)
    np.testing.assert_array_equal(
        read_points(path, shape=SHAPE, camera=None).points_m, points.astype(np.float64)
    )


def check_sphere(readings: dict) -> None:
    assert readings["sphericity_3d"].value == pytest.approx(1, abs=0.01)
    assert readings["ellipsoid_error"].value < 0.005


def refused(capsys: pytest.CaptureFixture[str], *arguments: Path | str) -> str:
    assert main(["measure", *map(str, arguments)]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert len(printed.err.splitlines()) == 1
    return printed.err


@pytest.mark.parametrize(
    "scale", [{"depth_scale": 0.001}, {"depth_scale": 1000}, {"depth_scale_m": 1.0}]
)
def test_steps_of_a_mistaken_length_are_refused_by_both_names(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], scale: dict[str, float]
) -> None:
    image = write_npy(tmp_path, steps_mm())
    cv2.imwrite(str(tmp_path / "image.png"), sphere_scene().image)
    camera = write_camera(tmp_path, **scale)
    files = (tmp_path / "image.png", "--range", image, "--camera", camera)
    said = refused(capsys, *files)
    assert "depth_scale is mm a step, depth_scale_m metres a step" in said
    assert "--range-unit" in said
    assert main(["measure", *map(str, files), "--range-unit", "1mm"]) == 0


@pytest.mark.parametrize("kind", ["depth", "xyz"])
@pytest.mark.parametrize("factor", [1000.0, 0.001])
def test_floats_in_another_unit_are_refused_unless_it_is_said(
    tmp_path: Path, kind: str, factor: float
) -> None:
    scene = sphere_scene()
    values = (scene.depth_m if kind == "depth" else scene.points_m) * np.float32(factor)
    camera = read_camera(write_camera(tmp_path))
    path = write_npy(tmp_path, values)
    with pytest.raises(InputError, match=r"z\.npy: range: expected a median of .* --range-unit"):
        read_points(path, shape=SHAPE, camera=camera)
    unit = {1000.0: "mm", 0.001: "km"}[factor]
    points = read_points(path, shape=SHAPE, camera=camera, unit=unit).points_m
    np.testing.assert_allclose(points, scene.points_m, rtol=1e-5, atol=1e-6)


def test_depth_scales_that_differ_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="depth_scale_m 1"):
        read_camera(write_camera(tmp_path, depth_scale=1.0, depth_scale_m=1.0))


def test_points_of_another_frame_are_refused_beside_a_camera(tmp_path: Path) -> None:
    points = sphere_scene().points_m
    camera = read_camera(write_camera(tmp_path))
    upward = points * np.array([1, -1, -1], dtype=np.float32)  # as OpenGL has it
    with pytest.raises(InputError, match=r"found 76800 of 76800 behind the camera"):
        read_points(write_npy(tmp_path, upward), shape=SHAPE, camera=camera)
    shifted = points + np.array([0.1, 0, 0], dtype=np.float32)
    with pytest.raises(InputError, match="px from their pixels"):
        read_points(write_npy(tmp_path, shifted), shape=SHAPE, camera=camera)


def test_kinds_need_their_number_of_values(tmp_path: Path) -> None:
    path = write_npy(tmp_path, sphere_scene().points_m)
    with pytest.raises(InputError, match="--range-kind depth: expected one value a pixel"):
        read_points(path, shape=SHAPE, camera=None, kind="depth")
    path = write_npy(tmp_path, sphere_scene().depth_m)
    with pytest.raises(InputError, match="--range-kind xyz: expected three values a pixel"):
        read_points(path, shape=SHAPE, camera=None, kind="xyz")


def test_the_radius_is_the_spheres(tmp_path: Path) -> None:
    path = write_npy(tmp_path, sphere_scene().distance_m)
    rock = measure_files(
        tmp_path, range=path, range_kind="distance", camera=write_camera(tmp_path)
    ).rocks[0]
    assert rock.ellipsoid is not None
    np.testing.assert_allclose(rock.ellipsoid.half_axes_m, RADIUS_M, rtol=0.01)
