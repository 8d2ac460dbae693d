"""Writing of a drawn series: image, SVG, labels and truth."""

import csv
import io
import shutil
from collections.abc import Sequence
from pathlib import Path
from tempfile import mkdtemp
from typing import Unpack

from synth.dataset.files import write_png
from synth.dataset.folder_lock import folder_lock
from synth.errors import SpecError
from synth.shapes.draw import DrawingOptions, draw_named_series
from synth.shapes.svg import svg_text

_DRAFT = ".rockshape-"  # begins the folder of files that are not whole yet
_FILES = ("image.png", "image.svg", "labels.png", "truth.csv")


def write_series(series: str, out: Path, **options: Unpack[DrawingOptions]) -> None:
    """Write image.png, image.svg, labels.png and truth.csv of a series into a folder.

    The options are those of `draw_named_series`.

    Raises:
        SpecError: an unknown series, a count, values, jitter, size or turn out of range, or
            a folder that is a file, holds other files or is being written by another run.
    """
    _check_free(out)
    shapes, drawing = draw_named_series(series, **options)
    svg = svg_text(shapes, drawing.drawn_px, drawing.middles_px, shape=drawing.labels.shape)
    try:
        with folder_lock(out):
            _check_free(out)
            for stale in out.glob(f"{_DRAFT}*"):
                shutil.rmtree(stale)
            draft = Path(mkdtemp(dir=out, prefix=_DRAFT))
            write_png(draft / "image.png", drawing.image)
            write_png(draft / "labels.png", drawing.labels)
            (draft / "image.svg").write_text(svg, encoding="utf-8", newline="")
            table = _table_text(series, drawing.rows)
            (draft / "truth.csv").write_text(table, encoding="utf-8", newline="")
            for file in _FILES:
                (draft / file).replace(out / file)
            draft.rmdir()
    except OSError as error:
        raise SpecError(f"{out}: expected a folder to write to, found {error.strerror}") from error


def _check_free(out: Path) -> None:
    """Raise SpecError unless a folder is new, empty or holds an earlier drawing and no more."""
    if out.exists() and not out.is_dir():
        raise SpecError(f"{out}: expected a folder to write to, found a file")
    held = {path.name for path in out.iterdir()} if out.is_dir() else set()
    drafts = {name for name in held if name.startswith(_DRAFT)}
    broken_off = bool(drafts) and held - drafts <= set(_FILES)
    if held and held != set(_FILES) and not broken_off:
        raise SpecError(f"{out}: expected an empty folder or a drawing, found other files")


def _table_text(series: str, rows: Sequence[dict[str, float]]) -> str:
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=["rock", "series", *list(rows[0])[1:]])
    writer.writeheader()
    for row in rows:
        values = {name: f"{value:.10g}" for name, value in row.items()}
        writer.writerow({**values, "series": series})
    return text.getvalue()
