"""Joining of many tables into one file, a table at a time."""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import IO, TYPE_CHECKING

from rockshape.errors import InputError
from rockshape.io.files import draft_of

if TYPE_CHECKING:
    import pandas as pd


def _csv(tables: "Iterator[pd.DataFrame]", stream: IO[bytes]) -> None:
    for number, table in enumerate(tables):
        stream.write(table.to_csv(index=False, header=not number, float_format="%.9g").encode())


def _json(tables: "Iterator[pd.DataFrame]", stream: IO[bytes]) -> None:
    mark = b"[\n"
    for table in tables:
        rows = table.to_json(orient="records", lines=True, double_precision=12).strip()
        for row in rows.splitlines():
            stream.write(mark + row.encode())
            mark = b",\n"
    stream.write(b"\n]" if mark == b",\n" else b"[]")


def _parquet(tables: "Iterator[pd.DataFrame]", stream: IO[bytes]) -> None:
    import pyarrow as pa  # noqa: PLC0415 - for this format alone
    import pyarrow.parquet as pq  # noqa: PLC0415

    writer = None
    for table in tables:
        rows = pa.Table.from_pandas(table, preserve_index=False)
        writer = pq.ParquetWriter(stream, rows.schema) if writer is None else writer
        writer.write_table(rows.cast(writer.schema))
    if writer is not None:
        writer.close()


WRITERS: Mapping[str, Callable[["Iterator[pd.DataFrame]", IO[bytes]], None]] = MappingProxyType(
    {".csv": _csv, ".json": _json, ".parquet": _parquet}
)


def write_joined(path: Path, tables: "Iterator[pd.DataFrame]") -> None:
    """Write tables of the same columns as one, whole or not at all, in the suffix's format.

    Raises: InputError where the file cannot be written.
    """
    with draft_of(path) as draft:
        WRITERS[path.suffix.lower()](tables, draft)


def check_joinable(path: Path) -> None:
    """Raises: InputError for a suffix that is none of `WRITERS`."""
    if path.suffix.lower() not in WRITERS:
        raise InputError(
            f"{path}: expected a table, {', '.join(WRITERS)}, or a folder, found '{path.suffix}'"
        )
