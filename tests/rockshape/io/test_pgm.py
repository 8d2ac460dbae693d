"""PGM: numbers as they are stored, whatever the greatest level that the file names."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from rockshape.errors import InputError
from rockshape.io import read_camera, read_labels, read_points

SHAPE = (3, 4)
NUMBERS = np.array([[0, 1, 1, 0], [0, 1, 1, 0], [3, 3, 0, 2]])
TEXT = b"P2\n# by hand\n4 3\n3\n0 1 1 0  0 1 1 0 # two rows\n3 3 0 2\n"
FILES = {
    "text": TEXT,
    "bytes": b"P5\n# by an editor\n4 3\n3\n" + NUMBERS.astype(np.uint8).tobytes(),
    "words": b"P5 4 3 1000\n" + NUMBERS.astype(">u2").tobytes(),
}


@pytest.mark.parametrize("data", FILES.values(), ids=FILES)
def test_numbers_are_ids(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "labels.pgm"
    path.write_bytes(data)
    found = read_labels(path, shape=SHAPE)
    assert [each.id for each in found] == [1, 2, 3]
    np.testing.assert_array_equal(found.to_labels(), NUMBERS)


def test_pillows_16_bits(tmp_path: Path) -> None:
    path = tmp_path / "labels.pgm"
    Image.fromarray((NUMBERS * 700).astype(np.uint16)).save(path)
    np.testing.assert_array_equal(read_labels(path, shape=SHAPE).to_labels(), NUMBERS * 700)


@pytest.mark.parametrize(
    "data", [b"P5 4 3 255\n12", b"P5 4 0x3 9\n", b"P2 4 3 9\n1 2", b"P5 4 3 70000\n", b"P5 4 3 0\n"]
)
def test_damage_is_one_line(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "labels.pgm"
    path.write_bytes(data)
    with pytest.raises(InputError, match=r"labels\.pgm: "):
        read_labels(path, shape=SHAPE)


def test_range_with_a_comment_in_its_header(tmp_path: Path) -> None:
    (tmp_path / "c.json").write_text(
        '{"fx": 9, "fy": 9, "cx": 2, "cy": 1, "width": 4, "height": 3, "depth_scale": 1}'
    )
    camera = read_camera(tmp_path / "c.json")
    steps = np.full(SHAPE, 1500, dtype=">u2")
    steps[0, 0] = 0
    (tmp_path / "z.pgm").write_bytes(b"P5\n# depth\n4 3\n65535\n" + steps.tobytes())
    depth_m = read_points(tmp_path / "z.pgm", shape=SHAPE, camera=camera).points_m[..., 2]
    np.testing.assert_allclose(depth_m[1:], 1.5)
    assert np.isnan(depth_m[0, 0])
