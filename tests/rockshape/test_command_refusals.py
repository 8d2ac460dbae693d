"""`rockshape measure` ends with status 2 and one line for each mistake, and leaves nothing."""

import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import tifffile

from rockshape.cli import main
from tests.paths import GRAINS_IMAGE, GRAINS_LABELS, MARS_IMAGE, MARS_RANGE


def spoil_image(folder: Path, how: str) -> Path:
    path = folder / "image.png"
    whole = MARS_IMAGE.read_bytes()
    match how:
        case "missing":
            return path
        case "empty":
            path.write_bytes(b"")
        case "cut":
            path.write_bytes(whole[: len(whole) // 2])
        case "text":
            path.write_text("this is no image")
        case "cut tiff":
            whole = GRAINS_LABELS.read_bytes()
            path.write_bytes(whole[: len(whole) // 2])
    return path


def fails_in_one_line(capsys: pytest.CaptureFixture[str], arguments: list[str], *says: str) -> None:
    """The command ends with status 2 and one line that says all that."""
    try:
        status = main(arguments)
    except SystemExit as end:
        status = end.code
    printed = capsys.readouterr()
    assert status == 2
    assert printed.out == ""
    assert len(printed.err.splitlines()) == 1, printed.err
    for words in says:
        assert words in printed.err


@pytest.mark.parametrize("how", ["missing", "empty", "cut", "text", "cut tiff"])
def test_a_bad_image(tmp_path: Path, capsys: pytest.CaptureFixture[str], how: str) -> None:
    path = spoil_image(tmp_path, how)
    arguments = ["measure", str(path), "--range", str(MARS_RANGE)]
    fails_in_one_line(capsys, arguments, str(path), "expected", "found")


class Payload:
    """Something that only a pickle could hold."""


def no_key(path: Path) -> None:
    np.savez(path, points=np.zeros((248, 256, 3)))


def pickled(path: Path) -> None:
    np.savez(path, xyz=np.array([Payload()], dtype=object))


def pickle_itself(path: Path) -> None:
    path.write_bytes(pickle.dumps([1, 2, 3]))


def other_shape(path: Path) -> None:
    np.savez(path, xyz=np.zeros((256, 248, 3)))


def depth_alone(path: Path) -> None:
    np.savez(path, depth=np.ones((248, 256)))


def words(path: Path) -> None:
    np.savez(path, xyz=np.full((248, 256, 3), "far"))


def cut(path: Path) -> None:
    path.write_bytes(MARS_RANGE.read_bytes()[:5000])


def empty(path: Path) -> None:
    path.write_bytes(b"")


def nothing_known(path: Path) -> None:
    path.write_bytes(b"\x93NUMPY\x01\x00v\x00{'descr': '<f8', 'shape': (99999999999,)}")


def folder(path: Path) -> None:
    path.mkdir()


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (no_key, "expected the key xyz or depth, found points"),
        (pickled, "pickled objects"),
        (pickle_itself, "pickled objects"),
        (other_shape, "found (256, 248, 3)"),
        (depth_alone, "expected a camera (camera, --camera)"),
        (words, "found <U3"),
        (cut, "expected range"),
        (empty, "found an empty file"),
        (folder, "found a directory"),
        (nothing_known, "expected range"),
    ],
)
def test_a_bad_range(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    make: Callable[[Path], None],
    says: str,
) -> None:
    path = tmp_path / "range.npz"
    make(path)
    arguments = ["measure", str(MARS_IMAGE), "--range", str(path)]
    fails_in_one_line(capsys, arguments, str(path), says)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('{"fx": 50, "fy": 50, "cx": 24, "cy": 19, "height": 4}', "width"),
        ('{"fy": 50, "cx": 24, "cy": 19, "width": 256, "height": 248}', "fx"),
        ('{"fx": 0, "fy": 5, "cx": 2, "cy": 1, "width": 256, "height": 248}', "fx"),
        ('{"fx": "far"}', "fx"),
        (
            '{"fx": 5, "fy": 5, "cx": 2, "cy": 1, "width": 2, "height": 2, "depth_scale": -1}',
            "depth_scale",
        ),
        ("[1, 2]", "object"),
        ("not JSON", "found"),
        ('{"fx": 5, "fy": 5, "cx": 2, "cy": 1, "width": 25, "height": 24}', "(24, 25)"),
    ],
)
def test_a_bad_camera(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, says: str
) -> None:
    path = tmp_path / "camera.json"
    path.write_text(text)
    arguments = ["measure", str(MARS_IMAGE), "--range", str(MARS_RANGE), "--camera", str(path)]
    fails_in_one_line(capsys, arguments, "camera", says)


@pytest.mark.parametrize(
    ("extra", "says"),
    [
        (["--method", "guess"], "method: expected one of paper, robust"),
        (["--method", "paper", "--uncertainty"], "estimates it (robust), found paper"),
        (["--out", "table.xlsx"], "table.xlsx"),
        (["--out", "nowhere/table.csv"], "nowhere"),
        (["--overlay", "picture.xyz"], "picture.xyz"),
        (["--labels-out", "labels.jpg"], "labels.jpg"),
        (["--labels", str(GRAINS_LABELS)], "(512, 512)"),
        (["--labels", str(GRAINS_IMAGE)], "found JPEG, whose lossy compression changes numbers"),
        (["--frobnicate"], "--frobnicate"),
        (["--out", "a.csv", "--labels-out", "a.png", "--overlay", "a.png"], "a.png"),
        (["--overlay", str(MARS_IMAGE)], "of its own"),
        (["--report", "page.txt"], "page.txt"),
        (["--range", str(MARS_IMAGE)], "16 bits"),
    ],
)
def test_bad_arguments(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    extra: list[str],
    says: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    arguments = ["measure", str(MARS_IMAGE), "--range", str(MARS_RANGE), *extra]
    fails_in_one_line(capsys, arguments, says)
    assert list(tmp_path.iterdir()) == []


def test_labels_beyond_16_bits_are_refused_before_anything_is_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    labels = tmp_path / "labels.tif"
    tifffile.imwrite(labels, np.full((248, 256), 70000, dtype=np.int32))
    table = tmp_path / "t.csv"
    outputs = ["--out", str(table), "--labels-out", str(tmp_path / "l.png")]
    fails_in_one_line(
        capsys, ["measure", str(MARS_IMAGE), "--labels", str(labels), *outputs], "found 70000"
    )
    assert not table.exists()


def test_nothing_to_find_rocks_by_says_what_to_give(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["measure", str(MARS_IMAGE), "--method", "paper"]
    fails_in_one_line(capsys, arguments, "--range", "--labels", "--find image")


def test_rocks_are_given_or_found(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["measure", str(GRAINS_IMAGE), "--labels", str(GRAINS_LABELS), "--find", "image"]
    fails_in_one_line(capsys, arguments, "find: expected no finder where rocks are given")


def test_a_file_the_system_refuses_is_one_line(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(path: Path, **_: object) -> None:
        raise OSError(28, "No space left on device", str(path))

    monkeypatch.setattr("rockshape.inputs.files.read_picture", refused)
    fails_in_one_line(capsys, ["measure", "a.png", "--range", "b.npz"], "a.png: No space left")


def test_a_full_disk_names_the_file_and_leaves_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(draft: Path, _: int) -> None:
        raise OSError(28, "No space left on device", str(draft))

    monkeypatch.setattr(Path, "chmod", full)
    table = tmp_path / "t.csv"
    arguments = ["measure", str(GRAINS_IMAGE), "--labels", str(GRAINS_LABELS), "--out", str(table)]
    fails_in_one_line(capsys, arguments, f"{table}: expected", "No space left")
    assert list(tmp_path.iterdir()) == []


def test_a_defect_keeps_its_traceback(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(path: Path, **_: object) -> None:
        raise ZeroDivisionError(path)

    monkeypatch.setattr("rockshape.inputs.files.read_picture", broken)
    with pytest.raises(ZeroDivisionError):
        main(["measure", "a.png", "--range", "b.npz"])


def test_an_argument_too_many_is_told_with_those_expected(capsys) -> None:
    fails_in_one_line(capsys, ["synth", "scene", "a.toml", "out"], "'out': expected OUT alone")
    fails_in_one_line(capsys, ["validate", "run", "ci"], "'ci': expected options alone")
