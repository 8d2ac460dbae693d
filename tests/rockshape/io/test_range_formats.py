"""The sphere's points are the same from every range format, to 0.5 % of those of NPY.

Writers are others' where there are light ones; PFM after Debevec, "PFM: portable float map"; PDS3
products after the MER camera SIS and the standards reference, chapter 5; the IMP table after the
data set MPFL-M-IMP-5-3DPOSITION-V1.0; OpenEXR after "The OpenEXR File Layout".
"""

import json
import sys
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
from tests.rockshape.io.exr_file import NONE, ZIPS, exr
from tests.rockshape.io.sphere_scene import CAMERA, Scene, measure_files, sphere_scene

SHAPE = (240, 320)
HOLE = np.s_[100:110, 150:160]
MM = {"depth_scale": 0.1}


def holed(values: np.ndarray, none: float) -> np.ndarray:
    filled = np.array(values)
    filled[HOLE] = none
    return filled


def pds3(folder: Path, values: np.ndarray, *, detached: bool, constant: str) -> Path:
    """A product of bands in sequence, 32-bit PC_REAL, as MER's XYZ and RNG products have it."""
    bands = np.moveaxis(values, -1, 0) if values.ndim == 3 else values[None]
    record, label_records = SHAPE[1] * 4, 0 if detached else 2
    pointer = '("product.img", 1)' if detached else label_records + 1
    label = [
        "PDS_VERSION_ID = PDS3",
        "RECORD_TYPE = FIXED_LENGTH",
        f"RECORD_BYTES = {record}",
        f"FILE_RECORDS = {label_records + len(bands) * SHAPE[0]}",
        *([] if detached else [f"LABEL_RECORDS = {label_records}"]),
        f"^IMAGE = {pointer}",
        "OBJECT = IMAGE",
        f"  LINES = {SHAPE[0]}",
        f"  LINE_SAMPLES = {SHAPE[1]}",
        "  SAMPLE_TYPE = PC_REAL",
        "  SAMPLE_BITS = 32",
        f"  BANDS = {len(bands)}",
        "  BAND_STORAGE_TYPE = BAND_SEQUENTIAL",
        f"  MISSING_CONSTANT = {constant}",
        "END_OBJECT = IMAGE",
        "END",
    ]
    text = ("\r\n".join(label) + "\r\n").encode()
    data = bands.astype("<f4").tobytes()
    path = folder / "product.img"
    path.write_bytes(data if detached else text.ljust(label_records * record) + data)
    if detached:
        path = folder / "product.lbl"
        path.write_bytes(text)
    return path


def imp_table(folder: Path, scene: Scene) -> Path:
    path = folder / "points.tab"
    rows = [
        f"{row + 1:5d},{col + 1:5d},{x:10.5f},{y:10.5f},{z:10.5f},  100"
        for (row, col), (x, y, z) in zip(
            np.ndindex(SHAPE), scene.points_m.reshape(-1, 3), strict=True
        )
        if not (100 <= row < 110 and 150 <= col < 160)
    ]
    path.write_text("\r\n".join(rows) + "\r\n")
    return path


def pfm(folder: Path, values: np.ndarray, *, order: str) -> Path:
    path = folder / "z.pfm"
    kind, scale = ("PF" if values.ndim == 3 else "Pf"), (-1.0 if order == "<" else 1.0)
    header = f"{kind}\n{SHAPE[1]} {SHAPE[0]}\n{scale}\n".encode()
    path.write_bytes(header + values[::-1].astype(f"{order}f4").tobytes())
    return path


def pcd(folder: Path, scene: Scene, encoding: pypcd4.Encoding) -> Path:
    path = folder / "cloud.pcd"
    points = holed(scene.points_m, np.nan).reshape(-1, 3)
    cloud = pypcd4.PointCloud.from_xyz_points(points.astype(np.float32))
    cloud.metadata.width, cloud.metadata.height = SHAPE[1], SHAPE[0]
    cloud.save(path, encoding=encoding)
    return path


def steps(scene: Scene, dtype: type = np.uint16) -> np.ndarray:
    return holed(np.rint(scene.depth_m * 10000), 0).astype(dtype)


def saved(path: Path, save: Callable[[str], object]) -> Path:
    save(str(path))
    return path


def ply(folder: Path, scene: Scene) -> Path:
    points = holed(scene.points_m, 0).reshape(-1, 3)
    return saved(folder / "c.ply", trimesh.PointCloud(points).export)


def exr_points(folder: Path, scene: Scene) -> Path:
    """Position pass of a layer, beside its colours."""
    points = holed(scene.points_m, 0).astype(np.float32)
    channels = {f"ViewLayer.Position.{axis}": points[..., k] for k, axis in enumerate("XYZ")}
    colour = np.zeros(SHAPE, np.float16)
    channels |= {f"ViewLayer.Combined.{name}": colour for name in "RGBA"}
    path = folder / "position.exr"
    path.write_bytes(exr(channels, compression=ZIPS))
    return path


def exr_depth(folder: Path, name: str, values: np.ndarray, compression: int = NONE) -> Path:
    path = folder / "z.exr"
    path.write_bytes(exr({name: values}, compression=compression))
    return path


Make = Callable[[Path, Scene], Path]
XYZ: dict[str, Make] = {
    "NPZ": lambda f, s: saved(f / "z.npz", lambda at: np.savez(at, xyz=holed(s.points_m, 0))),
    "TIFF points": lambda f, s: saved(
        f / "z.tif", lambda at: tifffile.imwrite(at, holed(s.points_m, 0), photometric="rgb")
    ),
    "PFM points": lambda f, s: pfm(f, holed(s.points_m, 0), order="<"),
    "PLY": ply,
    "PCD ascii": lambda f, s: pcd(f, s, pypcd4.Encoding.ASCII),
    "PCD binary": lambda f, s: pcd(f, s, pypcd4.Encoding.BINARY),
    "PCD compressed": lambda f, s: pcd(f, s, pypcd4.Encoding.BINARY_COMPRESSED),
    "PDS XYZ attached": lambda f, s: pds3(
        f, holed(s.points_m, 0), detached=False, constant="(0.0, 0.0, 0.0)"
    ),
    "PDS XYZ detached": lambda f, s: pds3(
        f, holed(s.points_m, -777), detached=True, constant="(-777.0, -777.0, -777.0)"
    ),
    "IMP table": imp_table,
    "EXR position": exr_points,
}
RASTERS: dict[str, tuple[Make, dict[str, float]]] = {
    "NPY depth": (
        lambda f, s: saved(f / "z.npy", lambda at: np.save(at, holed(s.depth_m, np.nan))),
        {},
    ),
    "TIFF depth": (
        lambda f, s: saved(f / "z.tif", lambda at: tifffile.imwrite(at, holed(s.depth_m, -9999))),
        {},
    ),
    "PNG": (lambda f, s: saved(f / "z.png", lambda at: cv2.imwrite(at, steps(s))), MM),
    "PGM": (lambda f, s: saved(f / "z.pgm", lambda at: cv2.imwrite(at, steps(s))), MM),
    "PFM little": (lambda f, s: pfm(f, holed(s.depth_m, np.inf), order="<"), {}),
    "PFM big": (lambda f, s: pfm(f, holed(s.depth_m, 0), order=">"), {}),
    "EXR float": (
        lambda f, s: exr_depth(f, "Z", holed(s.depth_m, 1e10).astype(np.float32), ZIPS),
        {},
    ),
    "EXR half": (
        lambda f, s: exr_depth(f, "Depth.Z", holed(s.depth_m, np.inf).astype(np.float16)),
        {},
    ),
    "EXR steps": (lambda f, s: exr_depth(f, "V", steps(s, np.uint32)), MM),
    "PDS RNG": (
        lambda f, s: pds3(f, holed(s.distance_m, 0), detached=False, constant="0.0"),
        {},
    ),
}


def difference(points: np.ndarray) -> float:
    """Greatest relative difference of a point from NPY's, and the hole where it was."""
    expected = holed(sphere_scene().points_m.astype(np.float64), np.nan)
    np.testing.assert_array_equal(np.isnan(points[..., 0]), np.isnan(expected[..., 0]))
    apart = np.linalg.norm(points - expected, axis=-1) / np.linalg.norm(expected, axis=-1)
    return float(np.nanmax(apart))


@pytest.mark.parametrize("make", XYZ.values(), ids=XYZ.keys())
def test_points_are_those_of_npy(tmp_path: Path, make: Make) -> None:
    path = make(tmp_path, sphere_scene())
    assert difference(read_points(path, shape=SHAPE, camera=None).points_m) < 0.005


@pytest.mark.parametrize(("make", "scale"), RASTERS.values(), ids=RASTERS.keys())
def test_rasters_give_the_points_of_npy(
    tmp_path: Path, make: Make, scale: dict[str, float]
) -> None:
    (tmp_path / "camera.json").write_text(json.dumps(CAMERA | scale))
    camera = read_camera(tmp_path / "camera.json")
    path = make(tmp_path, sphere_scene())
    assert difference(read_points(path, shape=SHAPE, camera=camera).points_m) < 0.005


@pytest.mark.parametrize("name", ["PCD compressed", "PDS XYZ detached", "IMP table"])
def test_the_sphere_measures_the_same(tmp_path: Path, name: str) -> None:
    rock = measure_files(tmp_path, range=XYZ[name](tmp_path, sphere_scene())).rocks[0]
    assert rock.readings["sphericity_3d"].value == pytest.approx(1, abs=0.01)


def test_wrong_sizes_and_damage_are_one_line(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    scene = sphere_scene()
    for name, make in (*XYZ.items(), *((name, make) for name, (make, _) in RASTERS.items())):
        folder = tmp_path / name.replace(" ", "_")
        folder.mkdir()
        path = make(folder, scene)
        with pytest.raises(InputError) as refused:
            read_points(path, shape=(24, 32), camera=None, unit="m")
        assert str(path) in str(refused.value)
        whole = path.read_bytes()
        path.write_bytes(whole[: len(whole) // 3])
        with pytest.raises(InputError) as refused:
            read_points(path, shape=SHAPE, camera=None)
        assert "\n" not in str(refused.value)
    assert capfd.readouterr() == ("", "")


def test_other_channels_and_windows_of_an_exr_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plane = np.ones(SHAPE, np.float32)
    path = tmp_path / "z.exr"
    wrong = [
        (exr({"R": plane, "G": plane, "B": plane}), "the channels B, G, R, not one Z"),
        (exr({"A.Z": plane, "B.Z": plane}), "the channels A.Z, B.Z, not one Z"),
        (exr({"Z": plane}, first=(10, 0)), "expected pixels for the whole picture"),
        (exr({f"layer{k:02}.V": plane for k in range(65)}), "65 channels"),
        (exr({"Z": np.ones((2000, 2000), np.float32)}), "as the image has"),
    ]
    for content, says in wrong:
        path.write_bytes(content)
        with pytest.raises(InputError, match=says):
            read_points(path, shape=SHAPE, camera=None)
    monkeypatch.setitem(sys.modules, "OpenEXR", None)
    with pytest.raises(InputError, match=r"pip install 'rockshape\[exr\]'"):
        read_points(path, shape=SHAPE, camera=None)
