"""Rows of the table of rocks: one rock in all its views, with what each method measured."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from markupsafe import Markup

from validation.records.pictures import Portrait
from validation.report.embed import symbols
from validation.report.rock_key import RockKey

Record = Mapping[str, object]


@dataclass(frozen=True)
class Column:
    """A measure of one method."""

    method: str
    measure: str
    title: str
    unit: str


@dataclass(frozen=True)
class Cell:
    """A measured value, and by how many ranks it is off in its view; None where not judged."""

    value: float
    off: int | None


@dataclass(frozen=True)
class ViewRow:
    """One rock in one view."""

    view: int
    status: str  # of the first method: matched, missed or extra
    plain: bool  # in plain sight: it counts
    visible: float  # share that is in sight, NaN where unknown
    iou: float
    picture: str | None  # the name of its symbol
    marks: tuple[str, ...]  # the methods whose lines that has
    cells: tuple[Cell, ...]  # of each column

    @property
    def worst(self) -> int | None:
        """The greatest of the ranks it is off."""
        return max((cell.off for cell in self.cells if cell.off is not None), default=None)


@dataclass(frozen=True)
class ShownRock:
    """One rock in all its views."""

    key: RockKey
    seed: int
    name: str
    about: str  # family and size
    truths: tuple[float, ...]
    views: tuple[ViewRow, ...]
    symbols: Markup


@dataclass(frozen=True)
class RowMaker:
    """What rows are made with: the columns, the truths, and by how much each value is off."""

    columns: tuple[Column, ...]
    truths: tuple[str, ...]
    off: Mapping[tuple[str, str, int], int]  # by method, measure and index of the record
    what: str

    def rock(
        self, key: RockKey, records: Sequence[tuple[int, Record]], portraits: Sequence[Portrait]
    ) -> ShownRock:
        """Rock from its records and portraits."""
        first = records[0][1]
        views: dict[int, dict[str, tuple[int, Record]]] = {}
        for index, record in records:
            found = views.setdefault(int(str(record["view"])), {})
            found[str(record["method"])] = index, record
        pictured = {one.picture.place.view: one for one in portraits}
        number = f"thing {key.rock}, no true {self.what}"
        return ShownRock(
            key=key,
            seed=int(str(first["seed"])),
            name=number if key.instance is None else f"{self.what} {key.instance + 1}",
            about=_about(first),
            truths=tuple(_float(first.get(truth)) for truth in self.truths),
            views=tuple(
                self.view(key, view, found, pictured.get(view))
                for view, found in sorted(views.items())
            ),
            symbols=Markup("").join(
                symbols(_symbol(key, view), one) for view, one in sorted(pictured.items())
            ),
        )

    def view(
        self,
        key: RockKey,
        view: int,
        found: Mapping[str, tuple[int, Record]],
        portrait: Portrait | None,
    ) -> ViewRow:
        """Rock in one view from what each method found of it."""
        first = next(iter(found.values()))[1]
        cells = []
        for column in self.columns:
            index, record = found.get(column.method, (-1, {}))
            off = self.off.get((column.method, column.measure, index))
            cells.append(Cell(_float(record.get(column.measure)), off))
        return ViewRow(
            view=view,
            status=str(first["status"]),
            plain=bool(first["eligible"]),
            visible=_float(first.get("truth_visible_fraction")),
            iou=_float(first.get("iou")),
            picture=None if portrait is None else _symbol(key, view),
            marks=() if portrait is None else tuple(m.method for m in portrait.picture.marks),
            cells=tuple(cells),
        )


def _symbol(key: RockKey, view: int) -> str:
    return f"{key.id.replace('rock-', 'p-', 1)}-{view}"


def _about(record: Record) -> str:
    """True rock's family and the lengths of its axes in words."""
    axes_m = [2.0 * _float(record.get(f"truth_axis_{axis}_m")) for axis in "abc"]
    family = record.get("family")
    parts = [family.replace("-", " ")] if isinstance(family, str) else []
    if np.isfinite(axes_m).all():
        parts.append(" × ".join(f"{100.0 * axis:.0f}" for axis in axes_m) + " cm")
    return ", ".join(parts)


def _float(value: object) -> float:
    """Cell's number; NaN where it is empty."""
    return float("nan") if value is None or value is pd.NA else float(str(value))
