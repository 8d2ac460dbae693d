"""Datasets of beds: files, COCO, resumption and replay."""

import json

import cv2
import numpy as np
import pandas as pd
import pytest
from pycocotools.coco import COCO

from synth.bed import write
from synth.bed.make import make_tile
from synth.bed.write import HEIGHT_STEP_PX, HEIGHT_ZERO, replay_beds, write_beds
from synth.errors import ReplayError, SpecError
from synth.spec.bed import convert_bed_spec

SPEC = convert_bed_spec(
    {"seed": 3, "tiles": 4, "width_px": 80, "height_px": 64, "bodies": 15}, where=""
)


@pytest.fixture(scope="module")
def dataset(tmp_path_factory):
    out = tmp_path_factory.mktemp("beds") / "out"
    write_beds(SPEC, out)
    return out


def content(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_the_files_hold_what_the_tiles_are(dataset):
    table = pd.read_csv(dataset / "rocks.csv")
    for index in range(4):
        bed = make_tile(SPEC, index)
        name = f"{index:06d}.png"
        image = cv2.imread(str(dataset / "images" / name))
        assert (image[..., ::-1] == bed.image).all()
        labels = cv2.imread(str(dataset / "labels" / name), cv2.IMREAD_UNCHANGED)
        assert labels.dtype == np.uint16
        assert (labels == bed.labels).all()
        stored = cv2.imread(str(dataset / "heights" / name), cv2.IMREAD_UNCHANGED).astype(float)
        heights = (stored - HEIGHT_ZERO) * HEIGHT_STEP_PX
        assert np.abs(heights - bed.height_px).max() <= HEIGHT_STEP_PX / 2 + 1e-6
        rows = table[table["tile"] == index]
        assert list(rows["id"]) == list(bed.rocks["id"])
        assert rows["width_px"].to_numpy() == pytest.approx(bed.rocks["width_px"], rel=1e-5)
    assert len(json.loads((dataset / "tiles.json").read_text())) == 4


@pytest.mark.filterwarnings(
    "ignore:__array__ implementation doesn't accept a copy keyword:DeprecationWarning"
)
def test_pycocotools_reads_masks_equal_to_the_labels(dataset, capsys):
    coco = COCO(str(dataset / "annotations.json"))
    capsys.readouterr()
    assert [one["name"] for one in coco.loadCats(coco.getCatIds())] == ["rock"]
    assert len(set(coco.getAnnIds())) == len(coco.anns) > 0
    for image in coco.loadImgs(coco.getImgIds()):
        labels = cv2.imread(
            str(dataset / "labels" / image["file_name"].removeprefix("images/")),
            cv2.IMREAD_UNCHANGED,
        )
        annotations = coco.loadAnns(coco.getAnnIds(image["id"]))
        assert {one["label"] for one in annotations} == set(np.unique(labels)) - {0}
        for one in annotations:
            mask = labels == one["label"]
            assert (coco.annToMask(one) == mask).all()
            assert one["area"] == mask.sum()
            x, y, width, height = one["bbox"]
            assert mask[y : y + height, x : x + width].sum() == mask.sum()


def test_processes_and_interruptions_change_no_byte(dataset, tmp_path, monkeypatch):
    write_beds(SPEC, tmp_path / "two", jobs=2)
    assert content(tmp_path / "two") == content(dataset)
    make = write.make_tile

    def breaking(spec, index):
        if index == 2:
            raise KeyboardInterrupt
        return make(spec, index)

    monkeypatch.setattr(write, "make_tile", breaking)
    with pytest.raises(KeyboardInterrupt):
        write_beds(SPEC, tmp_path / "broken")
    assert not (tmp_path / "broken" / "manifest.json").exists()
    monkeypatch.undo()
    write_beds(SPEC, tmp_path / "broken")
    assert content(tmp_path / "broken") == content(dataset)


def test_replay_compares_every_file(dataset, tmp_path):
    said = replay_beds(dataset / "manifest.json", tmp_path / "again")
    assert said.endswith("15 files, each with the manifest's SHA-256")
    assert content(tmp_path / "again") == content(dataset)
    table = json.loads((dataset / "manifest.json").read_text())
    table["files"]["labels/000001.png"] = "0" * 64
    (tmp_path / "manifest.json").write_text(json.dumps(table))
    with pytest.raises(ReplayError, match=r"labels/000001\.png"):
        replay_beds(tmp_path / "manifest.json", tmp_path / "other")


def test_a_folder_of_something_else_is_left_alone(dataset, tmp_path):
    (tmp_path / "mine.txt").write_text("mine")
    with pytest.raises(SpecError, match="found other files"):
        write_beds(SPEC, tmp_path)
    other = convert_bed_spec({"seed": 4, "tiles": 4}, where="")
    with pytest.raises(SpecError, match="found another spec"):
        write_beds(other, dataset)
    (tmp_path / "file").write_text("")
    with pytest.raises(SpecError, match="found a file"):
        write_beds(SPEC, tmp_path / "file")
