"""Suite `fused`: form of made rocks from each view alone and from views as one, by their poses."""

import msgspec
from case import Case, Cell, Column, Table

from validation.execution.run import Run, assess, prepare, units_of
from validation.execution.work import run_unit
from validation.kinds.fused.page.tables import form_rows
from validation.kinds.fused.spec import FusedExperiment
from validation.suite.suite import load_suite


def fused_suite(*, experiments: int = 2, scenes: int = 3) -> list[Table]:
    """Run so many experiments and scenes of the suite."""
    suite = prepare(load_suite("fused"))
    chosen = tuple(one.first(scenes) for one in suite.experiments[:experiments])
    suite = msgspec.structs.replace(suite, experiments=chosen)
    return tables(assess(suite, (), [run_unit(unit) for unit in units_of(suite)]))


def tables(run: Run) -> list[Table]:
    """Table of a finished run."""
    rows: list[tuple[Cell, ...]] = []
    for experiment in run.suite.experiments:
        assert isinstance(experiment, FusedExperiment)
        for row in form_rows(run, experiment):
            matched = None if row.matched is None else row.matched.value
            interval = f"{row.error.low:.3f} … {row.error.high:.3f}"
            scores = (row.error.value, interval, row.bias.value, row.tau.value)
            rows.append((experiment.title, row.words, row.error.count, matched, *scores))
    columns = (
        Column("rocks"),
        Column("from"),
        Column("values", "", "d"),
        Column("matched", "", ".2f"),
        Column("sphericity, RMS error", "", ".3f"),
        Column("95 %"),
        Column("bias", "", "+.3f"),
        Column("τ", "", ".2f"),
    )
    return [Table(columns, rows)]


FUSED_SUITE_CASE = Case(
    name="fused_suite",
    what="form of made rocks from each view alone and from four fused, as the suite has it",
    run=fused_suite,
    smallest={"experiments": 1, "scenes": 1},
)
