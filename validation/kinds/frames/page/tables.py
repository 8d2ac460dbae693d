"""Tables of frames: values of the named rocks, theirs and ours, and the orders stated of them."""

from dataclasses import dataclass

import numpy as np

from validation.execution.run import Run
from validation.kinds.frames.shipped import FRAMES
from validation.kinds.frames.spec import FramesExperiment
from validation.kinds.frames.statements import STATEMENTS
from validation.paper.tables import GARDEN_COLUMNS, garden_table
from validation.scores.titles import column_of, title_of


@dataclass(frozen=True)
class RockValues:
    """One measure of one named rock: the paper's value, and ours by each method."""

    figure: int
    rock: str
    title: str
    printed: float
    ours: tuple[float, ...]  # NaN where a method refuses


@dataclass(frozen=True)
class Order:
    """One statement of the paper, and by each method how many of its pairs are so."""

    figure: int
    title: str
    words: str
    ours: tuple[str, ...]


def rock_values(run: Run, experiment: FramesExperiment) -> list[RockValues]:
    """Rows of the table of values, frame by frame and rock by rock."""
    printed = garden_table()
    rows = []
    for scene, name in enumerate(experiment.frames):
        frame = FRAMES[name]
        for rock, row in frame.printed.items():
            for column, theirs in GARDEN_COLUMNS.items():
                ours = tuple(
                    value.get(rock, float("nan"))
                    for value in _values(run, experiment, scene, column).values()
                )
                value = printed[theirs].to_dict()[row]
                rows.append(RockValues(frame.figure, rock, title_of(column), value, ours))
    return rows


def orders(run: Run, experiment: FramesExperiment) -> list[Order]:
    """Rows of the table of statements."""
    figures = {FRAMES[name].figure: scene for scene, name in enumerate(experiment.frames)}
    rows = []
    for statement in STATEMENTS:
        if statement.figure not in figures:
            continue
        values = _values(run, experiment, figures[statement.figure], statement.measure)
        words = " < ".join(", ".join(rocks) for rocks in statement.rising)
        told = tuple(_told(statement.rising, own) for own in values.values())
        rows.append(Order(statement.figure, title_of(statement.measure), words, told))
    return rows


def _told(rising: tuple[tuple[str, ...], ...], values: dict[str, float]) -> str:
    """How many of the stated pairs are in order, of how many with two values."""
    pairs = [
        (values[low], values[high])
        for place, lows in enumerate(rising)
        for low in lows
        for highs in rising[place + 1 :]
        for high in highs
        if low in values and high in values
    ]
    right = sum(low < high for low, high in pairs)
    return f"{right} of {len(pairs)}" if pairs else "refused"


def _values(
    run: Run, experiment: FramesExperiment, scene: int, paper_column: str
) -> dict[str, dict[str, float]]:
    """Answered values of a measure by method and named rock."""
    records = run.records
    own = records[(records["experiment"] == experiment.name) & (records["scene"] == scene)]
    numbers = FRAMES[experiment.frames[scene]].rocks
    found: dict[str, dict[str, float]] = {}
    for method in experiment.methods:
        rows = own[(own["method"] == method) & own["instance"].notna()]
        values = dict(zip(rows["instance"] + 1, rows[column_of(method, paper_column)], strict=True))
        found[method] = {
            rock: float(values[number])
            for rock, number in numbers.items()
            if np.isfinite(values[number])
        }
    return found
