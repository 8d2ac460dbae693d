"""Lock of output folders: of two runs into one folder the second is refused, and spoils nothing."""

import subprocess
import sys

import pytest

from synth.dataset.folder_lock import folder_lock
from synth.dataset.generate import generate_dataset
from synth.errors import SpecError
from synth.shapes import write_series
from synth.spec import CameraSpec, RocksSpec, SceneSpec, ViewsSpec
from tests.digests import digests

SPEC = SceneSpec(
    seed=11,
    scenes=2,
    renderer="embree",
    rocks=RocksSpec(count=2, family="rounded-box", series="random"),
    camera=CameraSpec(preset="imp", supersample=1),
    views=ViewsSpec(count=1),
)
HOLD = """
import sys, time
from pathlib import Path
from synth.dataset.folder_lock import folder_lock
with folder_lock(Path(sys.argv[1])):
    print("held", flush=True)
    time.sleep(600)
"""


def test_the_second_run_is_refused_and_the_first_is_untouched(tmp_path) -> None:
    out, alone = tmp_path / "out", tmp_path / "alone"
    words = "scene --seed 11 --scenes 2 --renderer embree --rocks 2 --camera imp --views 1"
    words += " --site plain"
    command = [sys.executable, "-m", "rockshape.cli", "synth", *words.split()]
    runs = [
        subprocess.Popen([*command, str(out)], stderr=subprocess.PIPE, text=True) for _ in range(2)
    ]
    said = {run.wait(): run.communicate()[1] for run in runs}
    assert set(said) == {0, 2}
    assert said[2] == (
        f"rockshape: {out}: expected a folder that no other run writes to, found one at work\n"
    )
    assert subprocess.run([*command, str(alone)], check=False, capture_output=True).returncode == 0
    assert digests(out) == digests(alone)


def test_the_lock_of_a_dead_run_does_not_block(tmp_path) -> None:
    holder = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(tmp_path)], stdout=subprocess.PIPE, text=True
    )
    assert holder.stdout.readline() == "held\n"
    with pytest.raises(SpecError, match="no other run"), folder_lock(tmp_path):
        pass
    holder.kill()
    holder.communicate()
    with folder_lock(tmp_path):
        pass
    assert list(tmp_path.iterdir()) == []


def test_the_folder_is_made_and_kept(tmp_path) -> None:
    with folder_lock(tmp_path / "a" / "b"), folder_lock(tmp_path / "a"):
        assert (tmp_path / "a" / "b").is_dir()
    (tmp_path / "file").write_text("mine", encoding="utf-8")
    with pytest.raises(SpecError, match="expected a folder to write to"):
        folder_lock(tmp_path / "file").__enter__()


def test_a_folder_at_work_is_refused_by_both_writers(tmp_path) -> None:
    with folder_lock(tmp_path):
        for write in (
            lambda: generate_dataset(SPEC, tmp_path),
            lambda: write_series("roundness", tmp_path),
        ):
            with pytest.raises(SpecError, match="found one at work"):
                write()
    assert list(tmp_path.iterdir()) == []


def test_a_failing_run_removes_only_what_it_wrote(tmp_path) -> None:
    (tmp_path / ".partial").mkdir()
    tight = SceneSpec(rocks=RocksSpec(count=40, family="rounded-box", series="random"))
    with pytest.raises(SpecError, match="full"):
        generate_dataset(tight, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_a_drawing_that_was_broken_off_is_written_anew(tmp_path) -> None:
    write_series("roundness", tmp_path / "whole")
    broken = tmp_path / "broken"
    (broken / ".rockshape-x").mkdir(parents=True)
    (broken / "image.png").write_bytes(b"half")
    write_series("roundness", broken)
    assert digests(broken) == digests(tmp_path / "whole")
    (tmp_path / "image.png").write_bytes(b"mine")
    with pytest.raises(SpecError, match="found other files"):
        write_series("roundness", tmp_path)


def test_a_folder_is_removed_again_where_nothing_was_written(tmp_path) -> None:
    there, made, used = tmp_path / "there", tmp_path / "made", tmp_path / "used"
    there.mkdir()
    with folder_lock(there), folder_lock(made), folder_lock(used):
        (used / "file").touch()
    assert sorted(tmp_path.iterdir()) == [there, used]
