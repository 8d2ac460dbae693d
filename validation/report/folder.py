"""The folder of a run, written beside its place and moved there when it is whole."""

import json
import os
import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

from synth.text_file import read_text
from validation.errors import InputError
from validation.execution.recorded import FORMAT
from validation.execution.run import Run
from validation.execution.store import FOLDER, is_store_or_empty
from validation.report.junit import junit_xml
from validation.report.page import page_html
from validation.report.scores_json import scores_json
from validation.report.summary import summary_markdown

SCORES = "scores.json"
PAGE = "index.html"
_DRAFT = ".draft-"  # begins the folder of files that are not whole yet, within a run's folder
_FILES = (PAGE, SCORES, "results.parquet", "junit.xml", "summary.md")


def _is_run(folder: Path) -> bool:
    """Tell whether a folder holds a run, or one that was broken off: unit results, some files."""
    names = {path.name for path in folder.iterdir() if not path.name.startswith(_DRAFT)}
    if FOLDER in names and names <= {FOLDER, *_FILES} and is_store_or_empty(folder / FOLDER):
        return True
    try:
        held = json.loads(read_text(folder / SCORES))
    except (OSError, ValueError):
        return False
    return isinstance(held, dict) and held.get("format") == FORMAT


def check_target(out: Path) -> None:
    """Refuse a place that holds something other than an earlier run, before any work is done.

    Raises:
        InputError: a file, a folder with other things in it, or a place that cannot be written.
    """
    try:
        str(out).encode()
    except UnicodeEncodeError as error:
        raise InputError(f"--out: expected a name in UTF-8, found {str(out)!r}") from error
    if out.is_symlink() and not out.exists():
        raise InputError(f"--out: expected a folder, found a link to nowhere: {out}")
    if out.exists() and not out.is_dir():
        raise InputError(f"--out: expected a folder, found the file {out}")
    if out.is_dir() and any(out.iterdir()) and not _is_run(out):
        raise InputError(
            f"--out: expected an empty folder or an earlier run (with its {SCORES}), "
            f"found other files in {out}"
        )
    folder = next((out / name for name in _FILES if (out / name).is_dir()), None)
    if folder is not None:
        raise InputError(f"--out: expected a file or none, found the folder {folder}")
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        with _beside(out):
            pass
    except OSError as error:
        raise InputError(
            f"--out: expected a place for a folder, found {error.strerror}: {out.parent}"
        ) from error
    if out.is_dir() and not os.access(out, os.W_OK):
        raise InputError(f"--out: expected a folder that can be written, found {out}")


def _beside(out: Path) -> TemporaryDirectory[str]:
    """Folder for drafts on the disk of the run's own."""
    return TemporaryDirectory(prefix=f".{out.name}-", dir=out.parent)


def write_run(run: Run, out: Path, *, command: str, seconds: float) -> None:
    """Write the five files of a run.

    They are made in a folder beside `out`, or within where it exists, and moved when all are whole.
    An earlier run's files are replaced one by one, the page last; what else lies there stays.
    """
    check_target(out)
    for stale in out.glob(f"{_DRAFT}*"):
        shutil.rmtree(stale, ignore_errors=True)
    place = TemporaryDirectory(prefix=_DRAFT, dir=out) if out.is_dir() else _beside(out)
    with place as staging:
        whole = Path(staging).absolute() / "run"  # pyarrow takes a relative `a:b` for a URI
        whole.mkdir()
        run.records.to_parquet(whole / "results.parquet", index=False)
        (whole / SCORES).write_text(scores_json(run), encoding="utf-8")
        (whole / "junit.xml").write_text(junit_xml(run, seconds=seconds), encoding="utf-8")
        (whole / "summary.md").write_text(summary_markdown(run), encoding="utf-8")
        page = page_html(run, command=command, seconds=seconds)
        (whole / PAGE).write_text(page, encoding="utf-8")
        if not out.exists():
            whole.rename(out)
            return
        for file in sorted(whole.iterdir(), key=lambda file: (file.name == PAGE, file.name)):
            file.replace(out / file.name)
