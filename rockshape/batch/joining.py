"""Joining of many tables into one file, a table at a time."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import IO, TYPE_CHECKING, Any

from rockshape.errors import InputError
from rockshape.io.files import draft_of
from rockshape.io.tables.parquet import described_table
from rockshape.io.writers import write_side_file

if TYPE_CHECKING:
    import pandas as pd

    Tables = Iterator[pd.DataFrame]

About = Mapping[str, Any]
_GROUP_ROWS = 20_000  # at least, of Parquet: what is kept of a group costs memory and space


def _csv(tables: "Tables", stream: IO[bytes], _about: About) -> None:
    for number, table in enumerate(tables):
        stream.write(table.to_csv(index=False, header=not number, float_format="%.9g").encode())


def _json(tables: "Tables", stream: IO[bytes], _about: About) -> None:
    mark = b"[\n"
    for table in tables:
        rows = table.to_json(orient="records", lines=True, double_precision=12).strip()
        for row in rows.splitlines():
            stream.write(mark + row.encode())
            mark = b",\n"
    stream.write(b"\n]" if mark == b",\n" else b"[]")


def _parquet(tables: "Tables", stream: IO[bytes], about: About) -> None:
    """Write tables in row groups of many; what is known about them is written once."""
    import pyarrow as pa  # noqa: PLC0415 - for this format alone
    import pyarrow.parquet as pq  # noqa: PLC0415

    first = next(tables, None)
    if first is None:
        return
    waiting = [described_table(first, about)]
    schema, rows = waiting[0].schema, len(first)
    with pq.ParquetWriter(stream, schema) as writer:
        for table in tables:
            waiting.append(pa.Table.from_pandas(table, preserve_index=False).cast(schema))
            rows += len(table)
            if rows >= _GROUP_ROWS:
                writer.write_table(pa.concat_tables(waiting))
                waiting, rows = [], 0
        if waiting:
            writer.write_table(pa.concat_tables(waiting))


@dataclass(frozen=True)
class _Joined:
    """How tables are written as one, and whether what is known about them is within."""

    write: "Callable[[Tables, IO[bytes], About], None]"
    describes: bool = False


FORMATS: Mapping[str, _Joined] = MappingProxyType(
    {".csv": _Joined(_csv), ".json": _Joined(_json), ".parquet": _Joined(_parquet, describes=True)}
)


def write_joined(path: Path, tables: "Tables", *, about: About) -> None:
    """Write tables of the same columns as one, whole or not at all, in the suffix's format.

    Raises: InputError where the file cannot be written.
    """
    chosen = FORMATS[path.suffix.lower()]
    with draft_of(path) as draft:
        chosen.write(tables, draft, about)
    if not chosen.describes:
        write_side_file(path, about)


def check_joinable(path: Path) -> None:
    """Raises: InputError for a suffix that is none of `FORMATS`."""
    if path.suffix.lower() not in FORMATS:
        raise InputError(
            f"{path}: expected a table, {', '.join(FORMATS)}, or a folder, found '{path.suffix}'"
        )
