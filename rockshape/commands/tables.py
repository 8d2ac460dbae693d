"""Tables of rocks as commands take them: several together, and parted into groups."""

from pathlib import Path

import pandas as pd

from rockshape.errors import InputError, did_you_mean
from rockshape.io.tables.reading import read_table

TABLE = "table"  # column that tells the file


def joined(paths: list[Path]) -> pd.DataFrame:
    """All rows, with the name of their file."""
    names = [path.name for path in paths]
    told = names if len(set(names)) == len(names) else [str(path) for path in paths]
    tables = [
        read_table(path).assign(**{TABLE: name}) for path, name in zip(paths, told, strict=True)
    ]
    return pd.concat(tables, ignore_index=True)


def groups(table: pd.DataFrame, column: str | None) -> dict[str, pd.DataFrame]:
    """Rows by the values of a column; all of them under one name without one.

    Raises: InputError for a column that the tables have not.
    """
    if column is None:
        return {" + ".join(dict.fromkeys(table[TABLE])): table}
    if column not in table:
        hint = did_you_mean(column, list(table.columns))
        raise InputError(f"--group: expected a column of the tables, found {column!r}{hint}")
    return {str(name): rows for name, rows in table.groupby(column, sort=True, dropna=False)}
