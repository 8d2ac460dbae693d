"""TIFF images as tifffile and OpenCV write them: layouts, types, pixel size, orientation."""

import struct
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import tifffile
from PIL import Image, ImageOps

from rockshape.errors import InputError
from rockshape.io import read_image, read_picture
from rockshape.io.decoding.orientation import turn
from rockshape.io.decoding.raster import decode_tiff
from rockshape.io.files import InputFile

ROWS, COLS = 40, 50
LEVELS = (np.arange(ROWS)[:, None] * 5 + np.arange(COLS)) % 251
COLOURS = np.stack([LEVELS, LEVELS[::-1], LEVELS[:, ::-1]], axis=2).astype(np.uint8)


@pytest.mark.parametrize(
    "layout",
    [
        {},
        {"tile": (16, 32)},
        {"rowsperstrip": 7},
        {"byteorder": ">"},
        {"bigtiff": True},
        {"compression": "zlib", "predictor": True},
        {"compression": "zlib", "tile": (16, 16)},
        {"byteorder": ">", "tile": (16, 16), "compression": "zlib", "bigtiff": True},
    ],
    ids=str,
)
@pytest.mark.parametrize("planar", ["contig", "separate", None])
def test_every_layout_is_the_same_picture(
    tmp_path: Path, layout: dict[str, Any], planar: str | None
) -> None:
    path = tmp_path / "image.tif"
    pixels = LEVELS.astype(np.uint16) * 257 if planar is None else COLOURS
    stored = np.moveaxis(pixels, 2, 0) if planar == "separate" else pixels
    colour = {"photometric": "minisblack"}
    if planar is not None:
        colour = {"photometric": "rgb", "planarconfig": planar}
    tifffile.imwrite(path, stored, **layout, **colour)
    np.testing.assert_array_equal(read_picture(path).pixels, pixels)


@pytest.mark.parametrize(
    "kind",
    ["u1", "u2", "u4", "u8", "i1", "i2", "i4", "i8", "f2", "f4", "f8"],
)
def test_every_type_is_read(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "image.tif"
    values = (LEVELS % 100).astype(kind)  # what every type holds
    tifffile.imwrite(path, values)
    full = 65535 if kind == "u2" else 255
    np.testing.assert_allclose(read_image(path), values.astype(float) / full, atol=1e-6)


def test_floats_from_0_to_1_are_intensities_and_others_are_stretched(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    unit = np.linspace(0, 1, ROWS * COLS).reshape(ROWS, COLS).astype(np.float32)
    tifffile.imwrite(path, unit)
    np.testing.assert_array_equal(read_image(path), unit)
    tifffile.imwrite(path, unit * 37.5 - 12.25)
    # between the 0.1th and the 99.9th percentile of an even ramp
    expected = np.clip((unit - 0.001) / 0.998, 0, 1)
    np.testing.assert_allclose(read_image(path), expected, atol=1e-3)


def test_no_number_and_gdals_no_data_are_black(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    values = np.linspace(100, 200, ROWS * COLS).reshape(ROWS, COLS).astype(np.float32)
    values += 0.25
    values[3, 4], values[5, 6], values[7, 8] = np.nan, np.inf, -9999
    tifffile.imwrite(path, values, extratags=[(42113, "s", 0, "-9999", True)])
    found = read_image(path)
    assert found[3, 4] == found[5, 6] == found[7, 8] == 0
    assert np.isfinite(found).all()
    assert found[20, 20] == pytest.approx((values[20, 20] - 100.25) / 100, abs=0.01)


@pytest.mark.parametrize("kind", ["u1", "u2", "bool"])
def test_white_is_zero_is_shown_as_viewers_show_it(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "image.tif"
    stored = (LEVELS > 100) if kind == "bool" else LEVELS.astype(kind)
    tifffile.imwrite(path, stored, photometric="miniswhite")
    full = {"u1": 255, "u2": 65535, "bool": 1}[kind]
    np.testing.assert_allclose(read_image(path), 1 - stored.astype(float) / full, atol=1e-6)


def test_jpeg_within_tiff_is_close(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    smooth = cv2.GaussianBlur(COLOURS, (0, 0), 3)
    Image.fromarray(smooth).save(path, compression="jpeg", quality=95)
    np.testing.assert_allclose(read_picture(path).pixels, smooth, atol=8)
    Image.fromarray(smooth).convert("YCbCr").save(path, compression="jpeg", quality=95)
    np.testing.assert_allclose(read_picture(path).pixels, smooth, atol=12)


@pytest.mark.parametrize("bits", [2, 4, 12])
def test_fewer_bits_fill_the_scale(tmp_path: Path, bits: int) -> None:
    path = tmp_path / "image.tif"
    full = 2**bits - 1
    values = (LEVELS * 7 % (full + 1)).astype(np.uint16 if bits > 8 else np.uint8)
    values[0, 0] = full
    each_bit = values[..., None] >> np.arange(bits - 1, -1, -1) & 1
    packed = np.packbits(each_bit.astype(np.uint8).reshape(ROWS, -1), axis=1)
    write_packed(path, packed, bits)
    np.testing.assert_allclose(read_image(path), values / full, atol=1e-6)


def write_packed(path: Path, packed: np.ndarray, bits: int) -> None:
    """Uncompressed grey TIFF of few bits, after TIFF 6.0, sections 3 and 4."""
    entries = [(256, 4, COLS), (257, 4, ROWS), (258, 3, bits), (259, 3, 1), (262, 3, 1)]
    entries += [(273, 4, 8), (277, 3, 1), (278, 4, ROWS), (279, 4, packed.size)]
    directory = b"".join(struct.pack("<HHII", tag, kind, 1, value) for tag, kind, value in entries)
    data = struct.pack("<2sHI", b"II", 42, 8 + packed.size) + packed.tobytes()
    path.write_bytes(data + struct.pack("<H", len(entries)) + directory + struct.pack("<I", 0))


@pytest.mark.parametrize("orientation", range(1, 9))
def test_the_orientation_tag_turns_the_picture(tmp_path: Path, orientation: int) -> None:
    path = tmp_path / "image.tif"
    tifffile.imwrite(path, COLOURS, extratags=[(274, "H", 1, orientation, True)])
    with Image.open(path) as picture:
        expected = np.asarray(ImageOps.exif_transpose(picture))
    found = read_picture(path)
    np.testing.assert_array_equal(found.pixels, expected)
    assert found.orientation == orientation


def geotiff(unit: int | None, system: int = 32612, model: int = 1) -> list[tuple[Any, ...]]:
    """Tags of OGC 19-008r4, section 7: pixels of 0.25 by 0.25 units."""
    keys = [1024, 0, 1, model, 3072, 0, 1, system]
    keys += [] if unit is None else [3076, 0, 1, unit]
    keys = [1, 1, 0, len(keys) // 4, *keys]
    return [
        (33550, "d", 3, (0.25, 0.25, 0.0), True),
        (33922, "d", 6, (0.0, 0.0, 0.0, 440000.0, 4650000.0, 0.0), True),
        (34735, "H", len(keys), tuple(keys), True),
    ]


@pytest.mark.parametrize(
    ("tags", "size_m"),
    [
        (geotiff(9001), 0.25),
        (geotiff(None), 0.25),  # UTM is metric
        (geotiff(9002, system=2229), 0.25 * 0.3048),
        (geotiff(9003, system=2229), 0.25 * 1200 / 3937),
        (geotiff(None, system=2229), None),  # of an unknown unit
        (geotiff(9001, system=3857), None),  # metres of the equator
        (geotiff(9001, model=2), None),  # degrees
        ([], None),
    ],
)
def test_a_geotiff_tells_its_pixel_size(
    tmp_path: Path, tags: list[Any], size_m: float | None
) -> None:
    path = tmp_path / "image.tif"
    tifffile.imwrite(path, COLOURS, resolution=(72, 72), resolutionunit=2, extratags=tags)
    assert read_picture(path).pixel_size_m == (None if size_m is None else pytest.approx(size_m))


@pytest.mark.parametrize(
    ("unit", "metres"),
    [("mm", 1e-3), ("cm", 1e-2), ("\\u00B5m", 1e-6), ("inch", 0.0254), ("pixel", None)],
)
def test_an_imagej_tiff_tells_its_pixel_size(
    tmp_path: Path, unit: str, metres: float | None
) -> None:
    path = tmp_path / "image.tif"
    pixels = LEVELS.astype(np.uint16)
    tifffile.imwrite(path, pixels, imagej=True, resolution=(4.0, 4.0), metadata={"unit": unit})
    found = read_picture(path)
    assert found.pixel_size_m == (None if metres is None else pytest.approx(metres / 4, rel=1e-6))
    np.testing.assert_array_equal(found.pixels, pixels.astype(np.uint8))


def test_overviews_and_masks_are_passed_over_and_pages_refused(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    with tifffile.TiffWriter(path) as writer:
        writer.write(COLOURS, photometric="rgb")
        writer.write(COLOURS[::2, ::2], photometric="rgb", subfiletype=1)
        writer.write(np.ones((ROWS, COLS), bool), subfiletype=4)
    np.testing.assert_array_equal(read_picture(path).pixels, COLOURS)
    tifffile.imwrite(path, np.zeros((3, ROWS, COLS), np.uint8), photometric="minisblack")
    with pytest.raises(InputError, match=r"image\.tif: expected a TIFF of one page, found 3 pages"):
        read_picture(path)
    tifffile.imwrite(path, np.zeros((3, ROWS, COLS), np.uint8), imagej=True)
    with pytest.raises(InputError, match="found 3 pages"):
        read_picture(path)


def test_a_raw_mosaic_is_no_picture(tmp_path: Path) -> None:
    path = tmp_path / "raw.tif"
    tifffile.imwrite(
        path,
        LEVELS.astype(np.uint16),
        photometric=32803,
        extratags=[(33421, "H", 2, (2, 2), True), (33422, "B", 4, b"\0\1\1\2", True)],
    )
    with pytest.raises(InputError, match="photometric interpretation 32803"):
        read_picture(path)


def test_opencvs_tiffs_are_read(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    assert cv2.imwrite(str(path), COLOURS[..., ::-1])
    np.testing.assert_array_equal(read_picture(path).pixels, COLOURS)


@pytest.mark.parametrize("kind", ["u1", "u2", "u4", "i2", "i4", "f4", "f8"])
@pytest.mark.parametrize("colour", [False, True])
@pytest.mark.parametrize("compression", [5, 8, 32773])  # LZW, Deflate, PackBits
def test_opencvs_compressed_numbers(
    tmp_path: Path, kind: str, colour: bool, compression: int
) -> None:
    path = tmp_path / "image.tif"
    values = (COLOURS if colour else LEVELS).astype(kind)
    written = values[..., ::-1] if colour else values
    assert cv2.imwrite(str(path), written, [cv2.IMWRITE_TIFF_COMPRESSION, compression])
    found = decode_tiff(InputFile(path))
    assert found.dtype == values.dtype
    np.testing.assert_array_equal(found, values)


@pytest.mark.parametrize("compression", ["tiff_lzw", "packbits", "tiff_adobe_deflate", "zstd"])
@pytest.mark.parametrize("mode", ["L", "RGB", "RGBA", "1"])
def test_pillows_compressed_numbers(tmp_path: Path, mode: str, compression: str) -> None:
    path = tmp_path / "image.tif"
    picture = Image.fromarray(COLOURS).convert(mode)
    picture.save(path, compression=compression)
    np.testing.assert_array_equal(decode_tiff(InputFile(path)), np.asarray(picture))


@pytest.mark.parametrize("orientation", range(1, 9))
def test_compressed_pictures_are_turned_once(tmp_path: Path, orientation: int) -> None:
    path = tmp_path / "image.tif"
    deep = LEVELS.astype(np.uint16) * 257
    Image.fromarray(COLOURS).save(path, compression="tiff_lzw", tiffinfo={274: orientation})
    np.testing.assert_array_equal(read_picture(path).pixels, turn(COLOURS, orientation))
    tifffile.imwrite(path, deep, compression="zlib", extratags=[(274, "H", 1, orientation, True)])
    np.testing.assert_array_equal(read_picture(path).pixels, turn(deep, orientation))


def test_what_no_library_keeps_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    assert cv2.imwrite(str(path), LEVELS.astype(np.uint16), [cv2.IMWRITE_TIFF_COMPRESSION, 5])
    data = bytearray(path.read_bytes())
    at = data.index(struct.pack("<HHI", 259, 3, 1))
    data[at + 8 : at + 10] = struct.pack("<H", 34887)  # LERC, says the tag
    path.write_bytes(data)
    with pytest.raises(InputError, match="expected a TIFF without compression or by Deflate"):
        read_picture(path)


def test_libtiff_keeps_quiet_about_damage(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "image.tif"
    for pixels in (COLOURS, LEVELS.astype(np.uint16)):
        assert cv2.imwrite(str(path), pixels, [cv2.IMWRITE_TIFF_COMPRESSION, 5])
        data = bytearray(path.read_bytes())
        data[8:200] = b"\xff" * 192
        path.write_bytes(data)
        with pytest.raises(InputError, match=r"image\.tif: expected"):
            read_picture(path)
    assert capfd.readouterr().err == ""
