"""Every kind of image the contract names reads to the same grey values."""

from pathlib import Path

import numpy as np
import pytest
import tifffile
from PIL import Image

from rockshape.errors import InputError
from rockshape.io import read_image, read_labels, read_range, write_image
from tests import solids

RAMP = np.linspace(0, 1, 12).reshape(3, 4)


@pytest.mark.parametrize("ending", ["png", "tif"])
@pytest.mark.parametrize("bits", [8, 16])
def test_grey(tmp_path: Path, ending: str, bits: int) -> None:
    full = 2**bits - 1
    path = tmp_path / f"image.{ending}"
    write_image(path, np.rint(RAMP * full).astype(f"uint{bits}"))
    assert read_image(path) == pytest.approx(RAMP, abs=0.5 / full + 1e-7)  # rounding to a step


@pytest.mark.parametrize("mode", ["RGB", "RGBA", "LA", "P", "1"])
def test_colour_and_palettes_become_grey(tmp_path: Path, mode: str) -> None:
    path = tmp_path / "image.png"
    Image.fromarray(np.full((3, 4), 255, dtype=np.uint8)).convert(mode).save(path)
    # white is white in every mode; luma's weights sum to 1 within single precision
    assert read_image(path) == pytest.approx(np.ones((3, 4)), abs=1e-6)


def test_luma_weights_red_green_and_blue(tmp_path: Path) -> None:
    path = tmp_path / "image.png"
    colours = np.eye(3, dtype=np.uint8)[None] * 255
    write_image(path, colours)
    # ITU-R BT.601, rounded to 8 bits
    assert read_image(path)[0] == pytest.approx([0.299, 0.587, 0.114], abs=1 / 255)


def test_16_bit_colour_tiff(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    tifffile.imwrite(path, np.full((3, 4, 3), 32768, dtype=np.uint16), photometric="rgb")
    assert read_image(path) == pytest.approx(np.full((3, 4), 0.5), abs=1e-4)


def test_compressed_tiff(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    Image.fromarray(np.full((3, 4), 51, dtype=np.uint8)).save(path, compression="tiff_lzw")
    assert read_image(path) == pytest.approx(np.full((3, 4), 0.2))


def test_a_palette_in_a_tiff_becomes_its_colours(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    Image.fromarray(np.full((3, 4), 255, dtype=np.uint8)).convert("P").save(path)
    assert read_image(path) == pytest.approx(np.ones((3, 4)), abs=1e-6)


def test_planes_stored_apart_are_one_picture(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    planes = np.zeros((3, 6, 7), dtype=np.uint8)
    planes[1] = 255
    tifffile.imwrite(path, planes, photometric="rgb", planarconfig="separate")
    # green's weight in luma, rounded to 8 bits
    assert read_image(path) == pytest.approx(np.full((6, 7), 0.587), abs=1 / 255)


def test_a_float_image_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    tifffile.imwrite(path, RAMP.astype(np.float32))
    with pytest.raises(InputError, match="8 or 16 bits a channel, found float32"):
        read_image(path)


@pytest.mark.parametrize("kind", ["uint8", "uint16", "int32"])
def test_labels_keep_their_values(tmp_path: Path, kind: str) -> None:
    labels = np.array([[0, 3], [200, 0]], dtype=kind)
    path = tmp_path / "labels.tif"
    tifffile.imwrite(path, labels)
    assert np.array_equal(read_labels(path, shape=(2, 2)), labels)


@pytest.mark.parametrize("kind", ["uint8", "int64", ">i4"])
def test_labels_are_read_from_an_array(tmp_path: Path, kind: str) -> None:
    labels = np.array([[0, 3], [70, 0]], dtype=kind)
    np.save(tmp_path / "labels.npy", labels)
    found = read_labels(tmp_path / "labels.npy", shape=(2, 2))
    assert found.dtype == np.int32
    assert np.array_equal(found, labels)


def test_arrays_that_are_no_labels_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "labels.npy"
    objects = np.array([[None, {}]])
    for spoilt in (np.zeros((2, 2)), np.zeros((2, 2, 3), int), np.zeros((3, 2), int), objects):
        np.save(path, spoilt)
        with pytest.raises(InputError, match="expected"):
            read_labels(path, shape=(2, 2))
    for data in (b"", b"no array", path.read_bytes()[:40]):
        path.write_bytes(data)
        with pytest.raises(InputError, match="a label image"):
            read_labels(path, shape=(2, 2))
    with path.open("wb") as file:
        np.savez(file, one=np.zeros((2, 2), int))
    with pytest.raises(InputError, match="several arrays"):
        read_labels(path, shape=(2, 2))


def test_negative_labels_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "labels.tif"
    tifffile.imwrite(path, np.array([[0, -3]], dtype=np.int32))
    with pytest.raises(InputError, match="found -3 to 0"):
        read_labels(path, shape=(1, 2))


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
