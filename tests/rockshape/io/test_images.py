"""Image readers: 8 and 16 bits, grey, colour and palettes, as intensities from 0 to 1."""

from pathlib import Path

import numpy as np
import pytest
import tifffile
from PIL import Image

from rockshape.errors import InputError
from rockshape.io import read_image, read_pixels, write_image
from rockshape.io.pixels import to_grey

RAMP = np.linspace(0, 1, 12).reshape(3, 4)


@pytest.mark.parametrize("ending", ["png", "tif"])
@pytest.mark.parametrize("bits", [8, 16])
def test_grey(tmp_path: Path, ending: str, bits: int) -> None:
    full = 2**bits - 1
    path = tmp_path / f"image.{ending}"
    write_image(path, np.rint(RAMP * full).astype(f"uint{bits}"))
    assert read_image(path) == pytest.approx(RAMP, abs=0.5 / full + 1e-7)  # rounding to a step


@pytest.mark.parametrize(
    ("mode", "shape"),
    [
        ("RGB", (3, 4, 3)),
        ("RGBA", (3, 4, 3)),
        ("LA", (3, 4)),
        ("P", (3, 4, 3)),
        ("1", (3, 4)),
    ],
)
def test_white_is_white_in_every_mode(tmp_path: Path, mode: str, shape: tuple[int, ...]) -> None:
    path = tmp_path / "image.png"
    Image.fromarray(np.full((3, 4), 255, dtype=np.uint8)).convert(mode).save(path)
    np.testing.assert_array_equal(read_image(path), np.ones(shape))
    # luma's weights sum to 1 within single precision
    np.testing.assert_allclose(to_grey(read_pixels(path)), np.ones((3, 4)), atol=1e-6)


def test_colour_keeps_its_channels_in_the_order_red_green_blue(tmp_path: Path) -> None:
    path = tmp_path / "image.png"
    colours = np.array([[[255, 51, 0], [0, 102, 255]]], dtype=np.uint8)
    Image.fromarray(colours).save(path)
    np.testing.assert_allclose(read_image(path), [[[1, 0.2, 0], [0, 0.4, 1]]], atol=1e-6)


def test_luma_weights_red_green_and_blue(tmp_path: Path) -> None:
    path = tmp_path / "image.png"
    colours = np.eye(3, dtype=np.uint8)[None] * 255
    write_image(path, colours)
    # ITU-R BT.601, rounded to 8 bits
    assert to_grey(read_pixels(path))[0] == pytest.approx([0.299, 0.587, 0.114], abs=1 / 255)
    # floats are not rounded
    assert to_grey(read_image(path))[0] == pytest.approx([0.299, 0.587, 0.114], abs=1e-6)


def test_16_bit_colour_tiff(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    tifffile.imwrite(path, np.full((3, 4, 3), 32768, dtype=np.uint16), photometric="rgb")
    assert read_image(path) == pytest.approx(np.full((3, 4, 3), 0.5), abs=1e-4)


def test_compressed_tiff(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    Image.fromarray(np.full((3, 4), 51, dtype=np.uint8)).save(path, compression="tiff_lzw")
    assert read_image(path) == pytest.approx(np.full((3, 4), 0.2))


def test_a_palette_in_a_tiff_becomes_its_colours(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    Image.fromarray(np.full((3, 4), 255, dtype=np.uint8)).convert("P").save(path)
    assert read_image(path) == pytest.approx(np.ones((3, 4, 3)), abs=1e-6)


def test_planes_stored_apart_are_one_picture(tmp_path: Path) -> None:
    path = tmp_path / "image.tif"
    planes = np.zeros((3, 6, 7), dtype=np.uint8)
    planes[1] = 255
    tifffile.imwrite(path, planes, photometric="rgb", planarconfig="separate")
    green = np.zeros((6, 7, 3))
    green[..., 1] = 1
    np.testing.assert_array_equal(read_image(path), green)


@pytest.mark.parametrize("ending", ["jpg", "jpeg"])
def test_jpeg_holds_no_16_bits(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"image.{ending}"
    with pytest.raises(InputError, match=r"image\.jpe?g: expected 8 bits a channel .* uint16"):
        write_image(path, np.zeros((3, 4), dtype=np.uint16))
    assert not path.exists()
    grey = np.full((16, 16), 102, dtype=np.uint8)
    write_image(path, grey)
    np.testing.assert_allclose(read_image(path), 0.4, atol=1 / 255)  # a flat block loses nothing
