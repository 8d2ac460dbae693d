"""Summary of the rocks in tables, the work of `rockshape summarise`."""

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rockshape.commands.tables import TABLE, groups, joined
from rockshape.errors import InputError
from rockshape.io.files import check_writable, write_bytes
from rockshape.samples.comparison import Comparison, compare
from rockshape.samples.sample import sample_of
from rockshape.samples.size_column import size_column
from rockshape.samples.summarising import summary_of
from rockshape.samples.summary import Summary


@dataclass(frozen=True)
class SummariseOptions:
    """What `rockshape summarise` was asked for."""

    tables: list[Path]
    size: str | None
    least: float | None
    cut: bool
    group: str | None
    compare: bool
    area: float | None
    json: bool
    out: Path | None


def summarise_tables(options: SummariseOptions) -> None:
    """Summarise tables, and print or write that.

    Raises: InputError for tables and columns that cannot be used, before anything is written.
    """
    _check(options)
    table = joined(options.tables)
    column = size_column(table, options.size)
    least_m = None if options.least is None else options.least / 1000
    if options.area is not None and column.unit != "mm":
        raise InputError(f"--area: expected sizes in mm or m, found column {column.name}")
    summaries = {
        name: summary_of(
            sample_of(part, column, least=options.least, cut=options.cut),
            area_m2=options.area,
            least_m=least_m,
        )
        for name, part in groups(
            table, options.group or (TABLE if options.compare else None)
        ).items()
    }
    comparison = _comparison(summaries) if options.compare else None
    text = _json(summaries, comparison) if options.json else _text(summaries, comparison)
    if options.out is None:
        print(text)
    else:
        write_bytes(options.out, f"{text}\n".encode())


def _check(options: SummariseOptions) -> None:
    if options.out is not None:
        check_writable(options.out, suffixes=(".json", ".txt"))
    for name, value in (("--least", options.least), ("--area", options.area)):
        if value is not None and not 0 < value < math.inf:
            raise InputError(f"{name}: expected a number above 0, found {value:g}")


def _comparison(summaries: dict[str, Summary]) -> Comparison:
    if len(summaries) != 2:
        found = ", ".join(summaries)
        raise InputError(f"--compare: expected two groups or tables, found {found}")
    one, other = (summary.sample for summary in summaries.values())
    for name, sample in zip(summaries, (one, other), strict=True):
        if not len(sample):
            raise InputError(f"--compare: expected rocks in {name}, found none that count")
    return compare(one, other)


def _text(summaries: dict[str, Summary], comparison: Comparison | None) -> str:
    told = [line for name, summary in summaries.items() for line in summary.lines(name)]
    if comparison is not None:
        one, other = summaries
        told.append(comparison.line(one, other))
    return "\n".join(told)


def _json(summaries: dict[str, Summary], comparison: Comparison | None) -> str:
    told: dict[str, Any] = {"groups": {name: one.to_dict() for name, one in summaries.items()}}
    if comparison is not None:
        told["comparison"] = comparison.to_dict()
    return json.dumps(told, indent=1, ensure_ascii=False)
