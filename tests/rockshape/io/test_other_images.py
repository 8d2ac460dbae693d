"""JPEG, PNG, WebP, BMP and Netpbm as Pillow, OpenCV and the formats' specifications write them."""

import io
import struct
from pathlib import Path

import cv2
import numpy as np
import pytest
from PIL import Image, ImageOps

from rockshape.cli import main
from rockshape.errors import InputError
from rockshape.io import read_image, read_picture

ROWS, COLS = 40, 50
LEVELS = ((np.arange(ROWS)[:, None] * 5 + np.arange(COLS)) % 251).astype(np.uint8)
COLOURS = np.stack([LEVELS, LEVELS[::-1], LEVELS[:, ::-1]], axis=2)
LOSSLESS = {"webp": {"lossless": True}}


@pytest.mark.parametrize("ending", ["png", "bmp", "webp", "ppm"])
def test_pillows_colours(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"image.{ending}"
    Image.fromarray(COLOURS).save(path, **LOSSLESS.get(ending, {}))
    np.testing.assert_array_equal(read_picture(path).pixels, COLOURS)


@pytest.mark.parametrize("ending", ["png", "bmp", "webp", "ppm"])
def test_opencvs_colours(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"image.{ending}"
    options = [cv2.IMWRITE_WEBP_QUALITY, 101] if ending == "webp" else []
    assert cv2.imwrite(str(path), COLOURS[..., ::-1], options)
    np.testing.assert_array_equal(read_picture(path).pixels, COLOURS)


@pytest.mark.parametrize("ending", ["png", "bmp", "pgm"])
def test_grey(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"image.{ending}"
    Image.fromarray(LEVELS).save(path)
    np.testing.assert_array_equal(read_picture(path).pixels, LEVELS)


@pytest.mark.parametrize("ending", ["png", "pgm"])
def test_16_bits_of_opencv(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"image.{ending}"
    assert cv2.imwrite(str(path), LEVELS.astype(np.uint16) * 257)
    np.testing.assert_array_equal(read_picture(path).pixels, LEVELS.astype(np.uint16) * 257)


@pytest.mark.parametrize(
    ("data", "expected"),
    [  # Netpbm's pgm(5) and pbm(5)
        (b"P2\n# a comment\n3 2\n15\n0 5 15\n15 10 0\n", [[0, 1 / 3, 1], [1, 2 / 3, 0]]),
        (b"P5 3 1 1023\n" + struct.pack(">3H", 0, 341, 1023), [[0, 1 / 3, 1]]),
        (b"P1\n3 1\n0 1 0\n", [[1, 0, 1]]),
        (b"P4\n3 1\n\x40", [[1, 0, 1]]),
    ],
)
def test_netpbm_of_any_largest_level(tmp_path: Path, data: bytes, expected: list[float]) -> None:
    path = tmp_path / "image.pnm"
    path.write_bytes(data)
    np.testing.assert_allclose(read_image(path), expected, atol=1 / 255)


@pytest.mark.parametrize(
    ("ending", "mode"),
    [
        *(("png", mode) for mode in ("P", "1", "L", "LA", "RGB", "RGBA")),
        *(("tif", mode) for mode in ("P", "PA", "1", "L", "LA", "RGB", "RGBA")),
        *(("jpg", mode) for mode in ("1", "L", "RGB", "CMYK")),
    ],
)
def test_white_is_white_in_every_mode(tmp_path: Path, ending: str, mode: str) -> None:
    path = tmp_path / f"image.{ending}"
    Image.fromarray(np.full((16, 16, 3), 255, np.uint8)).convert(mode).save(path)
    np.testing.assert_allclose(read_image(path), 1, atol=1 / 255)


def test_inks_in_a_tiff_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    Image.fromarray(COLOURS).convert("CMYK").save(path)
    with pytest.raises(InputError, match="photometric interpretation 5"):
        read_image(path)


def exif(orientation: int) -> Image.Exif:
    tags = Image.Exif()
    tags[274] = orientation
    return tags


@pytest.mark.parametrize("orientation", range(1, 9))
@pytest.mark.parametrize("ending", ["jpg", "png", "webp"])
def test_pictures_are_turned_as_viewers_turn_them(
    tmp_path: Path, ending: str, orientation: int
) -> None:
    path = tmp_path / f"image.{ending}"
    Image.fromarray(COLOURS).save(path, exif=exif(orientation), **LOSSLESS.get(ending, {}))
    with Image.open(path) as picture:
        expected = np.asarray(ImageOps.exif_transpose(picture))
    found = read_picture(path)
    np.testing.assert_array_equal(found.pixels, expected)
    assert found.orientation == orientation
    if ending == "jpg":  # another viewer agrees, but for the decoder's rounding
        np.testing.assert_allclose(found.pixels, cv2.imread(str(path))[..., ::-1], atol=6)


def test_a_tag_that_says_nothing_turns_nothing(tmp_path: Path) -> None:
    path = tmp_path / "image.jpg"
    Image.fromarray(COLOURS).save(path, exif=exif(9))
    assert read_picture(path).pixels.shape == COLOURS.shape


def disc_files(folder: Path, orientation: int, rows: int, cols: int) -> tuple[Path, Path, Path]:
    """ImageContent with the tag, labels of the turned shape and labels of the stored shape."""
    pixels = np.zeros((rows, cols), np.uint8)
    pixels[5:15, 10:30] = 255
    turned = ImageOps.exif_transpose(_with_tag(pixels, orientation))
    paths = folder / "image.jpg", folder / "turned.png", folder / "stored.png"
    Image.fromarray(pixels).save(paths[0], exif=exif(orientation))
    turned.convert("L").point(lambda level: 3 * (level > 127)).save(paths[1], exif=b"")
    Image.fromarray((pixels > 127).astype(np.uint8) * 3).save(paths[2])
    return paths


def _with_tag(pixels: np.ndarray, orientation: int) -> Image.Image:
    held = io.BytesIO()
    Image.fromarray(pixels).save(held, "PNG", exif=exif(orientation))
    return Image.open(held)


def test_labels_are_of_the_turned_picture_or_the_message_names_exif(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    image, turned, stored = disc_files(tmp_path, 6, 24, 40)
    assert main(["measure", str(image), "--labels", str(turned)]) == 0
    printed = capsys.readouterr()
    assert printed.out.splitlines()[1].startswith("3,")
    assert ",200,10,20," in printed.out  # turned: 10 wide, 20 high
    assert "turned by its EXIF orientation 6" in printed.err
    assert main(["measure", str(image), "--labels", str(stored)]) == 2
    said = capsys.readouterr().err
    assert "expected (40, 24) as the image has, found (24, 40)" in said
    assert "EXIF orientation 6" in said
    camera = tmp_path / "camera.json"
    camera.write_text('{"fx": 50, "fy": 50, "cx": 20, "cy": 12, "width": 40, "height": 24}')
    assert main(["measure", str(image), "--camera", str(camera)]) == 2
    assert "EXIF orientation 6" in capsys.readouterr().err
    points = tmp_path / "range.npy"
    np.save(points, np.ones((24, 40, 3)))
    assert main(["measure", str(image), "--range", str(points)]) == 2
    assert "EXIF orientation 6" in capsys.readouterr().err


def test_a_square_picture_says_that_it_was_turned(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    image, turned, _ = disc_files(tmp_path, 8, 40, 40)
    assert main(["measure", str(image), "--labels", str(turned)]) == 0
    assert "EXIF orientation 8" in capsys.readouterr().err


@pytest.mark.parametrize("ending", ["png", "jpg"])
def test_an_orthophoto_is_read_and_a_limit_kept(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"large.{ending}"
    pixels = np.zeros((9000, 12000), np.uint8)
    pixels[4000:5000, 7000:9000] = 200
    assert cv2.imwrite(str(path), pixels)
    found = read_picture(path).pixels
    assert found.shape == pixels.shape
    assert found[4500, 8000] == 200
    with pytest.raises(InputError, match=r"at most 100000 pixels \(--max-pixels\), found 9000 x 1"):
        read_picture(path, max_pixels=100_000)


def test_the_limit_is_the_users(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "image.png"
    Image.fromarray(COLOURS).save(path)
    assert main(["measure", str(path), "--max-pixels", "1999"]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert read_picture(path, max_pixels=2000).pixels.shape == COLOURS.shape
