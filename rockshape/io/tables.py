"""Writing a table as CSV, JSON or Parquet."""

import io
from pathlib import Path

import pandas as pd

from rockshape.io.files import check_writable, write_bytes

TABLES = (".csv", ".json", ".parquet")


def write_table(path: Path | str, frame: pd.DataFrame) -> None:
    """Write the table whole or not at all; the path's ending says in which form.

    CSV leaves a NaN empty, JSON is a list of records with null for it.
    Raises InputError for another ending or a place that cannot be written.
    """
    path = Path(path)
    check_writable(path, endings=TABLES)
    write_bytes(path, _encode(frame, path.suffix.lower()))


def _encode(frame: pd.DataFrame, ending: str) -> bytes:
    match ending:
        case ".csv":
            return frame.to_csv(index=False, float_format="%.9g").encode()
        case ".json":
            return frame.to_json(orient="records", indent=1, double_precision=12).encode()
        case _:
            data = io.BytesIO()
            frame.to_parquet(data, index=False)
            return data.getvalue()
