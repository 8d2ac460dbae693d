"""Reading of tables that `rockshape measure` has written, and of others with such columns."""

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from rockshape.errors import InputError

if TYPE_CHECKING:
    import pandas as pd


def _csv(path: Path) -> "pd.DataFrame":
    import pandas as pd  # noqa: PLC0415 - it takes as long as all else

    return pd.read_csv(path)


def _json(path: Path) -> "pd.DataFrame":
    import pandas as pd  # noqa: PLC0415 - likewise

    return pd.read_json(path, orient="records")


def _parquet(path: Path) -> "pd.DataFrame":
    import pandas as pd  # noqa: PLC0415 - likewise

    return pd.read_parquet(path)


READERS: Mapping[str, Callable[[Path], "pd.DataFrame"]] = MappingProxyType(
    {".csv": _csv, ".json": _json, ".parquet": _parquet}
)


def read_table(path: Path) -> "pd.DataFrame":
    """Table of a CSV, JSON or Parquet file, or of a folder of Parquet files.

    Raises: InputError for a file that is missing, is no such table or has no row.
    """
    reader = _parquet if path.is_dir() else READERS.get(path.suffix.lower())
    if reader is None:
        raise InputError(f"{path}: expected a table, {', '.join(READERS)}, found '{path.suffix}'")
    if not path.exists():
        raise InputError(f"{path}: expected a table, found no such file")
    try:
        table = reader(path)
    except (ValueError, OSError, UnicodeDecodeError) as error:
        told = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise InputError(f"{path}: expected a table, found {told}") from error
    if table.empty:
        raise InputError(f"{path}: expected a table with rows, found none")
    return table
