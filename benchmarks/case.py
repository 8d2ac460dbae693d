"""Benchmark case: the record that each file in `cases/` fills."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

Cell = str | float | int | None  # None: no value


@dataclass(frozen=True)
class Column:
    """One column of a table: its name, its unit, and how docs format its numbers.

    Without a format numbers have three significant digits.
    """

    name: str
    unit: str = ""
    format: str = ""


@dataclass(frozen=True)
class Table:
    """Rows of figures. A case with several tables names each."""

    columns: Sequence[Column]
    rows: Sequence[Sequence[Cell]]
    name: str = ""

    def __post_init__(self) -> None:
        """Refuse a row that is longer or shorter than the columns."""
        for row in self.rows:
            if len(row) != len(self.columns):
                raise ValueError(f"row {row}: expected {len(self.columns)} cells, found {len(row)}")


@dataclass(frozen=True)
class Case:
    """One benchmark: what it measures, the function to run, and the options of its smallest size.

    `run` returns its tables; its options' defaults are the full size, that of the figures in docs.
    Where `peer` names another implementation or a floor, it is measured in the same run, and the
    columns "ratio" are relative to it.
    """

    name: str
    what: str
    run: Callable[..., Sequence[Table]]
    smallest: Mapping[str, Any] = field(default_factory=dict)  # that of a smoke test
    peer: str = ""
    threads: int = 1
    slow: bool = False  # left out unless it is named, at its full size
