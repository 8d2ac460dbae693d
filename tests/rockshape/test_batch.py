"""`rockshape measure` of many images: pairing, one table, bad files, resuming."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import cv2
import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

from rockshape.batch import joining
from rockshape.batch.images import images_of, is_batch
from rockshape.batch.pairing import Companion, paired
from rockshape.cli import main
from rockshape.errors import InputError

SCALE = ["--scale", "0.5mm"]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Current folder with four pictures and their masks; one picture is none."""
    monkeypatch.chdir(tmp_path)
    for name in ("photos", "masks"):
        (tmp_path / name).mkdir()
    for number in range(4):
        mask = np.zeros((90, 120), np.uint8)
        for rock in range(number + 1):
            cv2.circle(mask, (20 + 25 * rock, 40), 8 + rock, rock + 1, -1)
        cv2.imwrite(f"photos/p{number}.png", 60 + 20 * mask)
        cv2.imwrite(f"masks/p{number}_mask.png", mask)
    (tmp_path / "photos" / "bad.png").write_text("no picture")
    cv2.imwrite("masks/bad.png", mask)
    return tmp_path


def run(*words: object) -> int:
    return main(["measure", *map(str, words)])


def test_a_folder_becomes_one_table_and_a_bad_file_stops_nothing(folder, capsys) -> None:
    assert run("photos", "--labels", "masks", *SCALE, "--out", "t.csv", "--jobs", 2) == 0
    table = pd.read_csv("t.csv")
    assert table["image"].tolist() == [f"photos/p{n}.png" for n in range(4) for _ in range(n + 1)]
    told = capsys.readouterr().err
    assert "5 images; --labels by name from masks" in told
    assert "4 images measured; 10 rocks" in told
    assert "photos/bad.png: expected an image" in told
    # as the single command says of each
    assert run("photos/p2.png", "--labels", "masks/p2_mask.png", *SCALE, "--out", "one.csv") == 0
    own = table[table["image"] == "photos/p2.png"].drop(columns="image").reset_index(drop=True)
    pd.testing.assert_frame_equal(own, pd.read_csv("one.csv"), check_dtype=False)
    tables = {"t.csv", "t.csv.meta.json", "one.csv", "one.csv.meta.json"}
    assert {path.name for path in folder.iterdir()} == {"photos", "masks", *tables}


def test_quiet_tells_what_failed_and_nothing_else(capsys) -> None:
    assert run("photos", "--labels", "masks", "--out", "t.csv", "--jobs", 1, "--quiet") == 0
    told = capsys.readouterr().err.splitlines()
    assert told[0] == "1 image failed:"
    assert len(told) == 2
    assert run("photos/p0.png", "--labels", "masks/p0_mask.png", "--quiet", "--json") == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    assert [row["rock"] for row in json.loads(printed.out)] == [1]


@pytest.mark.parametrize("out", ["t.csv", "t.json", "t.parquet", "parts"])
def test_all_tables_hold_the_same(out: str) -> None:
    assert run("photos", "--labels", "masks", "--out", out, "--jobs", 1) == 0
    read = {"csv": pd.read_csv, "json": pd.read_json}.get(out[2:], pd.read_parquet)
    assert read(out)["rock"].tolist() == [1, 1, 2, 1, 2, 3, 1, 2, 3, 4]
    assert main(["summarise", out, "--size", "width_px"]) == 0


def test_strict_and_no_image_at_all_end_with_2() -> None:
    common = ["--labels", "masks", "--out", "t.csv", "--jobs", 1]
    assert run("photos", *common, "--strict") == 2
    assert Path("t.csv").exists()  # what could be measured is there
    assert run("photos/bad.png", "photos/bad.png", *common) == 2
    assert not Path("t.csv.parts").exists()


def test_patterns_lists_and_pictures_out() -> None:
    Path("list.txt").write_text("photos/p1.png\n\nphotos/p3.png\n")
    Path("over").mkdir()
    pattern = "masks/{stem}_mask.png"
    words = ["--labels", pattern, "--overlay", "over", "--labels-out", "over/{stem}_l.png"]
    assert run("list.txt", *words, "--out", "t.csv", "--jobs", 1) == 0
    assert {path.name for path in Path("over").iterdir()} == {
        "p1.png", "p1_l.png", "p3.png", "p3_l.png",
    }  # fmt: skip
    labels = cv2.imread("over/p3_l.png", cv2.IMREAD_UNCHANGED)
    assert np.array_equal(labels, cv2.imread("masks/p3_mask.png", cv2.IMREAD_UNCHANGED))
    assert run("photos/p*.png", "--labels", pattern, "--out", "u.csv", "--jobs", 1) == 0
    assert pd.read_csv("u.csv")["image"].nunique() == 4


def test_masks_beside_pictures_are_no_pictures() -> None:
    for path in Path("masks").glob("p*"):
        path.rename(Path("photos") / path.name)
    Path("photos/bad.png").unlink()
    assert run("photos", "--labels", "photos/{stem}_mask.png", "--out", "t.csv", "--jobs", 1) == 0
    assert pd.read_csv("t.csv")["image"].nunique() == 4


def test_a_run_goes_on_where_it_stopped(capsys) -> None:
    common = ["--labels", "masks", "--out", "parts", "--jobs", 1, "--resume"]
    assert run("photos/p0.png", "photos/p1.png", *common) == 0
    before = {path: path.stat().st_mtime_ns for path in Path("parts").glob("*.parquet")}
    assert run("photos/p0.png", "photos/p1.png", "photos/p2.png", *common) == 0
    assert all(path.stat().st_mtime_ns == time_ns for path, time_ns in before.items())
    assert "3 images measured (2 of them before); 6 rocks" in capsys.readouterr().err
    # another option or another picture is another result, and none is left over
    assert run("photos/p0.png", "photos/p1.png", *common, "--descriptors") == 0
    assert "2 images measured;" in capsys.readouterr().err
    assert len(list(Path("parts").glob("*.parquet"))) == 2
    cv2.imwrite("photos/p1.png", np.zeros((90, 120), np.uint8))
    assert run("photos/p0.png", "photos/p1.png", *common, "--descriptors") == 0
    assert "(1 of them before)" in capsys.readouterr().err


def test_a_killed_run_leaves_whole_parts_and_is_resumed_to_the_same_table() -> None:
    rng = np.random.default_rng(0)
    mask = cv2.imread("masks/p3_mask.png", cv2.IMREAD_UNCHANGED)
    for number in range(10, 60):
        cv2.imwrite(f"photos/p{number}.png", rng.integers(0, 255, mask.shape, dtype=np.uint8))
        cv2.imwrite(f"masks/p{number}_mask.png", mask)
    words = ["measure", "photos", "--labels", "masks", "--out", "t.csv", "--jobs", "1"]
    run_it = [sys.executable, "-m", "rockshape.cli", *words]
    begun = subprocess.Popen(run_it, stderr=subprocess.DEVNULL)
    parts = Path("t.csv.parts")
    until = time.monotonic() + 60
    while len(list(parts.glob("*.parquet"))) < 5 and time.monotonic() < until:
        time.sleep(0.01)
    os.kill(begun.pid, signal.SIGKILL)
    begun.wait()
    assert not Path("t.csv").exists()
    assert all(len(pd.read_parquet(path)) for path in parts.glob("*.parquet"))
    assert main([*words, "--resume"]) == 0
    resumed = Path("t.csv").read_bytes()
    assert main(words) == 0
    assert Path("t.csv").read_bytes() == resumed


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["photos", "--labels", "masks"], "--out: expected a file or folder"),
        (["photos", "--out", "t.xlsx"], "t.xlsx: expected a table"),
        (["photos", "--out", "no/t.csv"], "expected an existing folder"),
        (["photos", "--out", "t.csv", "--report", "p.pdf"], "p.pdf: expected"),
        (["photos", "--out", "t.csv", "--overlay", "o.png"], "--overlay: expected a folder"),
        (["masks/*.jpg", "--out", "t.csv"], "expected a pattern of images, found no such file"),
        (["photos", "--out", "photos"], "expected a new folder or a batch's"),
        (["photos", "--out", "t.csv", "--jobs", "0"], "--jobs"),
        (["photos", "--out", "t.csv", "--method", "robst"], "robst"),
    ],
)
def test_what_no_batch_can_do_is_told_before_any_work(folder, capsys, words, told) -> None:
    assert run(*words) == 2
    error = capsys.readouterr().err.splitlines()[-1]
    assert told in error
    assert {path.name for path in folder.iterdir()} <= {"photos", "masks"}


def test_two_pictures_of_one_name_do_not_overwrite_an_overlay(capsys) -> None:
    Path("more").mkdir()
    Path("more/p0.png").write_bytes(Path("photos/p0.png").read_bytes())
    Path("over").mkdir()
    words = ["--labels", "masks", "--out", "t.csv", "--overlay", "over"]
    assert run("photos/p0.png", "more/p0.png", *words) == 2
    assert "a name of its own" in capsys.readouterr().err


def test_one_image_is_no_batch() -> None:
    assert not is_batch(["photos/p0.png"])
    assert not is_batch(["photos/p[0].png".replace("[0]", "0")])
    assert is_batch(["photos"])
    assert is_batch(["photos/p*.png"])
    assert images_of(["photos/p1.png", "photos/p*.png"])[0] == Path("photos/p1.png")


def test_pairs_are_by_name_and_never_guessed() -> None:
    image = Path("photos/p1.png")
    cv2.imwrite("masks/p11.png", np.zeros((9, 9), np.uint8))  # of another picture
    assert Companion("--labels", "masks").of(image) == Path("masks/p1_mask.png")
    cv2.imwrite("masks/p1-old.png", np.zeros((9, 9), np.uint8))
    with pytest.raises(InputError, match="expected one file"):
        Companion("--labels", "masks").of(image)
    found, lacking = paired([image], {"labels": Companion("--labels", "masks")})
    assert not found
    assert list(lacking) == [image]
    cv2.imwrite("masks/p1.tif", np.zeros((9, 9), np.uint8))  # the same name goes first
    assert Companion("--labels", "masks").of(image) == Path("masks/p1.tif")


def test_a_folder_is_listed_once_for_all_images(monkeypatch, tmp_path: Path) -> None:
    masks = tmp_path / "many"
    masks.mkdir()
    images = [tmp_path / f"p{number}.png" for number in range(200)]
    for image in images:
        (masks / f"{image.stem}_mask.png").touch()
    listed = []
    plain = Path.iterdir
    monkeypatch.setattr(Path, "iterdir", lambda path: listed.append(path) or plain(path))
    found, lacking = paired(images, {"labels": Companion("--labels", str(masks))})
    assert lacking == {}
    assert {image.stem for image in images} == {
        files["labels"].stem.removesuffix("_mask") for files in found.values()
    }
    assert all(files["labels"].stem == f"{image.stem}_mask" for image, files in found.items())
    assert listed == [masks]


def test_many_tables_are_joined_in_few_row_groups_that_tell_their_inputs_once(
    monkeypatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(joining, "_GROUP_ROWS", 100)
    described = []
    plain = joining.described_table
    monkeypatch.setattr(
        joining, "described_table", lambda *given: described.append(1) or plain(*given)
    )
    tables = [
        pd.DataFrame({"rock": [1, 2, 3], "value": [number, np.nan, 0.5]}) for number in range(70)
    ]
    path = tmp_path / "joined.parquet"
    joining.write_joined(path, iter(tables), about={"inputs": ["a", "b"]})
    kept = pq.ParquetFile(path)
    assert [kept.metadata.row_group(k).num_rows for k in range(kept.num_row_groups)] == [
        102,
        102,
        6,
    ]
    assert described == [1]
    assert json.loads(kept.schema_arrow.metadata[b"rockshape"]) == {"inputs": ["a", "b"]}
    pd.testing.assert_frame_equal(pd.read_parquet(path), pd.concat(tables, ignore_index=True))
