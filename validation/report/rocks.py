"""The table of rocks: a row for each rock and view, and for each rock its views side by side."""

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from markupsafe import Markup

from rockshape.method import find_method
from validation.execution.run import Run
from validation.records.pictures import Portrait
from validation.report.embed import symbols
from validation.report.rank_error import ranks_off
from validation.report.rock_key import RockKey, keys_of
from validation.scores.scoring import claims_of
from validation.scores.titles import title_of, unit_of
from validation.suite.experiment import MeasuredExperiment

TRUTHS = {
    "truth_angularity": "true angularity",
    "truth_maximum_projection_sphericity": "true sphericity",
    "truth_axis_ratio": "true axis ratio",
    "truth_rectangle_ratio": "true side ratio",
}


@dataclass(frozen=True)
class Subject:
    """What is measured in an experiment, as the page speaks of it."""

    what: str = "rock"
    several_views: bool = True
    outlines_only: bool = False  # there is no range


ROCKS = Subject()


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
class RockTable:
    """The rocks of an experiment that the page shows."""

    experiment: MeasuredExperiment
    subject: Subject
    truths: tuple[str, ...]  # titles
    columns: tuple[Column, ...]
    rocks: tuple[ShownRock, ...]
    total: int  # true rocks of the experiment

    @property
    def methods(self) -> tuple[str, ...]:
        """The methods in the order of their columns."""
        return tuple(dict.fromkeys(column.method for column in self.columns))

    @property
    def true_rocks(self) -> int:
        """How many of the rocks shown are true ones."""
        return sum(rock.key.instance is not None for rock in self.rocks)


def _columns(
    run: Run, experiment: MeasuredExperiment, records: pd.DataFrame, subject: Subject
) -> tuple[Column, ...]:
    columns = [
        Column(method, measure.column, measure.title, measure.unit)
        for method in experiment.methods
        for measure in find_method(method).measures
        if not (subject.outlines_only and measure.needs_range)
    ]
    columns += [
        Column(spec.name, column, title_of(column), unit_of(column))
        for spec in run.suite.measures
        for column in spec.expected_trait
    ]
    return tuple(column for column in columns if column.measure in records.columns)


Record = Mapping[str, object]


def rock_table(
    run: Run,
    experiment: MeasuredExperiment,
    chosen: Mapping[RockKey, Sequence[Portrait]],
    subject: Subject = ROCKS,
) -> RockTable:
    """Chosen rocks of an experiment in the order of its scenes.

    A rock has a row for each view that shows anything of it.
    """
    own = run.records[run.records["experiment"] == experiment.name]
    if "truth_visible_fraction" in own:
        own = own[own["truth_visible_fraction"] != 0]
    keys = sorted(
        (key for key in chosen if key.experiment == experiment.name),
        key=lambda key: (key.series, key.scene, key.instance is None, key.instance or 0, key.id),
    )
    near = own[own["scene"].isin({key.scene for key in keys})]
    off = {
        (claim.method, claim.measure, index): ranks
        for claim in claims_of(run.suite, experiment)
        for index, ranks in ranks_off(near, claim).items()
    }
    truths = tuple(name for name in TRUTHS if name in near and near[name].notna().any())
    maker = _Maker(_columns(run, experiment, own, subject), truths, off, subject.what)
    rows: dict[RockKey, list[tuple[int, Record]]] = {}
    records: list[dict[Hashable, object]] = near.to_dict(orient="records")
    for index, record, key in zip(near.index.tolist(), records, keys_of(near), strict=True):
        named = {str(name): value for name, value in record.items()}
        rows.setdefault(key, []).append((int(index), named))
    true_rocks = own[own["status"] != "extra"][["series", "scene", "instance"]]
    return RockTable(
        experiment=experiment,
        subject=subject,
        truths=tuple(TRUTHS[name] for name in truths),
        columns=maker.columns,
        rocks=tuple(maker.rock(key, rows[key], chosen[key]) for key in keys if key in rows),
        total=len(true_rocks.drop_duplicates()),
    )


@dataclass(frozen=True)
class _Maker:
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
