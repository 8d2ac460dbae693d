"""The table of rocks: a row for each rock and view, and for each rock its views side by side."""

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from rockshape.method import find_method
from validation.execution.run import Run
from validation.records.pictures import Portrait
from validation.report.rank_error import ranks_off
from validation.report.rock_key import RockKey, keys_of
from validation.report.rock_rows import Column, Record, RowMaker, ShownRock
from validation.scores.scoring import claims_of
from validation.scores.titles import title_of, unit_of
from validation.suite.experiment import Experiment

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
class RockTable:
    """The rocks of an experiment that the page shows."""

    experiment: Experiment
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
    run: Run, experiment: Experiment, records: pd.DataFrame, subject: Subject
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


def rock_table(
    run: Run,
    experiment: Experiment,
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
    maker = RowMaker(_columns(run, experiment, own, subject), truths, off, subject.what)
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
