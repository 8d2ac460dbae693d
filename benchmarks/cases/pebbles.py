"""Pebbles of suite `outlines`: what a half and a third of the resolution leave of each measure."""

import msgspec
from case import Case, Cell, Column, Table

from validation.execution.run import assess, prepare, units_of
from validation.execution.work import run_unit
from validation.kinds.pebbles.judge import STATISTICS
from validation.kinds.pebbles.spec import PebblesExperiment
from validation.scores.score import Key
from validation.scores.scoring import claims_of
from validation.suite.suite import load_suite

HELD = {"pebbles": "scale chosen on them", "pebbles-held-out": "held out"}


def pebbles_by_resolution(*, experiments: int = len(HELD)) -> list[Table]:
    """Run the suite's experiments on pebbles."""
    suite = prepare(load_suite("outlines"))
    own = [one for one in suite.experiments if isinstance(one, PebblesExperiment)]
    suite = msgspec.structs.replace(suite, experiments=tuple(own[:experiments]))
    run = assess(suite, (), [run_unit(unit) for unit in units_of(suite)])
    scores = {score.key: score for score in run.scores}
    rows: list[tuple[Cell, ...]] = []
    for experiment in own[:experiments]:
        known = dict.fromkeys((c.method, c.measure) for c in claims_of(suite, experiment))
        for method, measure in sorted(known, key=lambda one: one[0] != "robust"):
            head = (HELD[experiment.name], method, f"`{measure}`")
            cells: list[Cell] = []
            for series in experiment.series:
                change, tau, answered = (
                    scores[Key(experiment.name, method, series, measure, each.key)]
                    for each in STATISTICS
                )
                cells += [change.value, f"{tau.value:.2f} ({tau.low:.2f} … {tau.high:.2f})"]
                cells.append(100 * answered.value)
            rows.append((*head, answered.count, *cells))
    columns = [Column("photographs"), Column("by"), Column("measure"), Column("pebbles", "", "d")]
    for part in ("1/2", "1/3"):
        columns += [Column(f"{part}: change of the median", "", "+.3f"), Column("τ")]
        columns.append(Column("answered", "%", ".0f"))
    return [Table(tuple(columns), rows)]


PEBBLES_CASE = Case(
    name="pebbles",
    what="2-D measures of real pebbles at full, half and a third of the resolution",
    run=pebbles_by_resolution,
    smallest={"experiments": 1},
)
