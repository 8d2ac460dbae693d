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


def _csv(tables: "Tables", stream: IO[bytes], about: About) -> None:  # noqa: ARG001
    for number, table in enumerate(tables):
        stream.write(table.to_csv(index=False, header=not number, float_format="%.9g").encode())


def _json(tables: "Tables", stream: IO[bytes], about: About) -> None:  # noqa: ARG001
    mark = b"[\n"
    for table in tables:
        rows = table.to_json(orient="records", lines=True, double_precision=12).strip()
        for row in rows.splitlines():
            stream.write(mark + row.encode())
            mark = b",\n"
    stream.write(b"\n]" if mark == b",\n" else b"[]")


def _parquet(tables: "Tables", stream: IO[bytes], about: About) -> None:
    import pyarrow.parquet as pq  # noqa: PLC0415 - for this format alone

    writer = None
    for table in tables:
        rows = described_table(table, about)
        writer = pq.ParquetWriter(stream, rows.schema) if writer is None else writer
        writer.write_table(rows.cast(writer.schema))
    if writer is not None:
        writer.close()


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
