"""Expectation (claim): a column rises with a truth, as its measure declares beside its formula.

A column whose measure expects no trait is measured and stored, but not judged. Each kind says which
of its truths stands for a trait.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from rockshape.measures import Measure
from rockshape.method import find_method, measure_of
from validation.peers import MeasureSpec, Trait
from validation.suite.experiment import Experiment

TRUTH = "truth_"  # begins a truth's name as a column of the records


class JudgedColumn(NamedTuple):
    """A column that is expected to rise with a trait.

    One from elsewhere that bears the name of a measure of ours is held to the same truths.
    """

    method: str  # or the name of a measure from elsewhere
    name: str
    trait: Trait
    measure: Measure | None


@dataclass(frozen=True)
class Claim:
    """A method's column rises with a truth, in one experiment and series."""

    experiment: str
    series: str  # of shapes; the step of a sweep; empty for other rocks
    method: str
    measure: str  # the column
    truth: str  # a column of the records
    per_view: bool = False  # the truth is that of the outline in each view, not of the rock
    same_quantity: bool = False  # measure and truth are one quantity: their difference is an error


def columns_of(experiment: Experiment, measures: Sequence[MeasureSpec]) -> Iterator[JudgedColumn]:
    """Columns that are judged: those of the methods, then those of other measures."""
    for method in experiment.methods:
        for measure in find_method(method).measures:
            if measure.expected_trait is not None:
                yield JudgedColumn(method, measure.column, measure.expected_trait, measure)
    for spec in measures:
        for column, trait in spec.expected_trait.items():
            yield JudgedColumn(spec.name, column, trait, measure_of(column))


def rock_claim(
    experiment: str, series: str, column: JudgedColumn, *, truth: str, same_quantity: bool
) -> Claim:
    """Claim of a column on a truth of the rock."""
    return Claim(
        experiment,
        series,
        column.method,
        column.name,
        TRUTH + truth,
        same_quantity=same_quantity,
    )
