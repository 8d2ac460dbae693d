"""COCO, GeoJSON and RoiSet as written: read back they hold the same pixels, also of holes."""

import json
from pathlib import Path

import numpy as np
import pytest
import roifile
from scipy import ndimage

from rockshape.io import read_labels, write_labels
from rockshape.io.encoding.pixel_rings import pixel_rings, signed_area
from rockshape.io.labels.coco import _run_lengths
from rockshape.rock.instances import Instance, Instances


def blobs(seed: int) -> Instances:
    """Random rocks with holes, several pieces and pixels that touch at corners; some overlap."""
    rng = np.random.default_rng(seed)
    items = []
    for number in range(1, 6):
        field = ndimage.gaussian_filter(rng.standard_normal((30, 40)), rng.uniform(0.7, 2.5))
        mask = field > np.quantile(field, 0.6)
        row, col = rng.integers(0, 30, 2).tolist()
        items.append(Instance(3 * number, np.s_[row : row + 30, col : col + 40], mask))
    return Instances((60, 70), tuple(items))


def masks(instances: Instances) -> dict[int, np.ndarray]:
    whole = {}
    for each in instances:
        whole[each.id] = np.zeros(instances.shape, bool)
        whole[each.id][each.window] = each.mask
    return whole


@pytest.mark.parametrize("suffix", [".json", ".geojson", ".zip"])
@pytest.mark.parametrize("seed", range(12))
def test_what_is_written_is_read_back_to_the_pixel(tmp_path: Path, suffix: str, seed: int) -> None:
    written = blobs(seed)
    path = tmp_path / f"rocks{suffix}"
    write_labels(path, written)
    read = masks(read_labels(path, shape=written.shape, pieces="keep"))
    for number, mask in masks(written).items():
        assert np.array_equal(read[number], mask)


def test_rings_have_the_area_of_the_pixels_and_turn_by_their_side() -> None:
    mask = np.zeros((6, 7), bool)
    mask[1:5, 1:6] = True
    mask[2:4, 2:4] = False
    outer, hole = sorted(pixel_rings(mask), key=signed_area, reverse=True)
    assert outer.tolist() == [[1, 1], [6, 1], [6, 5], [1, 5]]  # clockwise as seen, y down
    assert signed_area(outer) == 20
    assert signed_area(hole) == -4
    corners = np.eye(2, dtype=bool)  # two pixels that touch at a corner
    assert [signed_area(ring) for ring in pixel_rings(corners)] == [1, 1]


def test_coco_is_one_image_of_one_class(tmp_path: Path) -> None:
    disc = np.hypot(*np.mgrid[-9:10, -9:10]) < 9
    ring = disc & (np.hypot(*np.mgrid[-9:10, -9:10]) > 4)
    items = (Instance(1, np.s_[2:21, 3:22], disc), Instance(2, np.s_[30:49, 3:22], ring))
    write_labels(tmp_path / "rocks.json", Instances((60, 40), items))
    content = json.loads((tmp_path / "rocks.json").read_text())
    assert (content["images"][0]["width"], content["images"][0]["height"]) == (40, 60)
    first, second = content["annotations"]
    assert first["bbox"] == [3, 2, 19, 19]
    assert first["area"] == disc.sum()
    assert isinstance(first["segmentation"], list)
    counts = second["segmentation"]["counts"]
    assert sum(counts) == 60 * 40
    assert sum(counts[1::2]) == ring.sum() == second["area"]


@pytest.mark.parametrize("filled", [np.s_[:, :], np.s_[:0, :0], np.s_[-1:, -1:], np.s_[:1, :1]])
def test_run_lengths_of_extreme_masks(filled: tuple[slice, slice]) -> None:
    mask = np.zeros((4, 5), bool)
    mask[filled] = True
    counts = _run_lengths(mask)
    assert sum(counts) == mask.size
    values = np.repeat(np.arange(len(counts)) % 2, counts).astype(bool)
    assert np.array_equal(values.reshape(mask.shape, order="F"), mask)


def test_a_set_of_regions_is_read_by_roifile(tmp_path: Path) -> None:
    disc = np.hypot(*np.mgrid[-9:10, -9:10]) < 9
    ring = disc & (np.hypot(*np.mgrid[-9:10, -9:10]) > 4)
    items = (Instance(4, np.s_[2:21, 3:22], disc), Instance(9, np.s_[30:49, 3:22], ring))
    written = Instances((60, 40), items)
    for name in ("rocks.zip", "again.zip"):
        write_labels(tmp_path / name, written)
    assert (tmp_path / "rocks.zip").read_bytes() == (tmp_path / "again.zip").read_bytes()
    whole, holed = roifile.roiread(tmp_path / "rocks.zip")
    assert (whole.name, whole.roitype.name) == ("rock-4", "TRACED")
    assert (whole.left, whole.top, whole.right, whole.bottom) == (4, 3, 21, 20)
    assert (holed.name, holed.composite) == ("rock-9", True)
    assert len(holed.coordinates(multi=True)) == 2
    assert (holed.left, holed.top, holed.right, holed.bottom) == (4, 31, 21, 48)
