"""Named rocks of figures 11 and 12: the paper's orders and values, and ours on hand outlines."""

import pandas as pd
from case import Case, Cell, Column, Table

from validation.execution.run import assess, prepare, units_of
from validation.execution.work import run_unit
from validation.kinds.frames.page.tables import orders, rock_values
from validation.suite.suite import load_suite


def frames() -> list[Table]:
    """Run the suite `pathfinder`: its orders, then its values."""
    suite = prepare(load_suite("pathfinder"))
    run = assess(suite, suite.gates, [run_unit(unit) for unit in units_of(suite)])
    (experiment,) = suite.experiments
    methods = [Column(f"`{method}`") for method in experiment.methods]
    stated: list[tuple[Cell, ...]] = [
        (each.figure, each.title, each.words, *each.ours) for each in orders(run, experiment)
    ]
    values: list[tuple[Cell, ...]] = [
        (each.figure, each.rock, each.title, each.printed, *map(_shown, each.ours))
        for each in rock_values(run, experiment)
    ]
    head = Column("figure", "", "d")
    return [
        Table((head, Column("measure"), Column("the paper's order, rising"), *methods), stated),
        Table(
            (head, Column("rock"), Column("measure"), Column("table 4", "", ".2f"), *methods),
            values,
        ),
    ]


def _shown(value: float) -> str:
    return f"{value:.3g}" if pd.notna(value) else "–"


PAPER_FRAMES_CASE = Case(
    name="paper_frames",
    what="figures 11 and 12 of the paper: orders and values of the named rocks",
    run=frames,
    smallest={},
)
