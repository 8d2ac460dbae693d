"""Page of a batch: its images beside one another, charts and table over all."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from pathlib import Path
from typing import Any

from rockshape.batch.parts import ResultFolder
from rockshape.io.files import draft_of
from rockshape.measurement import AXES
from rockshape.method import Method
from rockshape.report.drawing import MOST_PX
from rockshape.report.page import PageContent, page_parts
from rockshape.report.section import Section, SectionOrder
from rockshape.report.verdict import joined
from rockshape.samples.size_column import DEFAULTS

MAX_PICTURES = 100
MAX_ROWS = 5000  # of the page's table, but for those of the first image
MIN_SIDE_PX = 160  # of a picture


def section_order(number: int, images: int) -> SectionOrder:
    """How image `number` of so many is drawn; all pictures together are as large as one alone."""
    side_px = max(MIN_SIDE_PX, int(MOST_PX / images**0.5))
    return SectionOrder(f"{number}-", side_px if number < MAX_PICTURES else 0)


def write_batch_report(
    path: Path, parts: ResultFolder, keys: Sequence[str], method: Method
) -> None:
    """Write the page of results that have sections, whole or not at all.

    Memory grows with the values of the charts alone, some hundred bytes a rock.
    """
    names = parts.column_names(keys[0])
    wanted = {*DEFAULTS, *AXES, "truncated", *(each.column for each in method.measures)}
    shown = list(_shown(parts, keys))
    rocks = sum(parts.rocks(key) for key in keys)
    listed = sum(parts.rocks(key) for key in shown)
    left_out = (
        ""
        if len(shown) == len(keys)
        else (
            f"Pictures and table are those of the first {len(shown)} images with {listed} rocks; "
            f"the table that was written has all {rocks}."
        )
    )
    content = PageContent(
        title=f"{path.stem}: {len(keys)} images",
        method=method.name,
        measures=method.measures,
        tally=joined(_section(parts, key).tally for key in keys),
        values=parts.values(keys, [name for name in names if name in wanted]),
        columns=names,
        filled=parts.filled(keys),
        sections=(_section(parts, key) for key in shown),
        rows=_rows(parts, shown),
        left_out=left_out,
    )
    with draft_of(path) as draft:
        for piece in page_parts(content):
            draft.write(piece.encode())


def _shown(parts: ResultFolder, keys: Sequence[str]) -> Iterator[str]:
    """Results from the first on whose pictures and rows a page has room for."""
    rocks = 0
    for key in islice(keys, MAX_PICTURES):
        rocks += parts.rocks(key)
        if rocks > MAX_ROWS and key != keys[0]:
            return
        if not _section(parts, key).drawing:
            return
        yield key


def _section(parts: ResultFolder, key: str) -> Section:
    return Section.from_json(parts.section(key))


def _rows(parts: ResultFolder, keys: Sequence[str]) -> Iterator[tuple[str, Mapping[Any, Any]]]:
    for key, table in zip(keys, parts.tables(keys), strict=True):
        prefix = int(key.partition("-")[0])
        for row in table.to_dict(orient="records"):
            yield f"{prefix}-{row['rock']}", {**row, "image": Path(row["image"]).name}
