"""Suite result: scores and gates as tables, for scripts and notebooks."""

from dataclasses import dataclass
from html import escape
from pathlib import Path

import pandas as pd

from validation.execution.run import Run
from validation.scores.score import Score
from validation.suite.gates import GateResult, tally


@dataclass(frozen=True, eq=False, repr=False)
class SuiteResult:
    """Outcome of a suite."""

    name: str
    scores: pd.DataFrame  # one row a score: value, unit, count, 95 % interval
    gates: pd.DataFrame  # one row a gate: the score, its bound, what was found, whether it passed
    records: pd.DataFrame  # one row a view, method and rock: truth and measures side by side
    passed: bool  # every gate
    tally: str  # how many gates passed or failed, in words
    report: Path | None  # folder of the report, if one was asked for

    def __repr__(self) -> str:
        """Suite's name and its count of passed gates."""
        return f"SuiteResult({self.name!r}: {self.tally})"

    def _repr_html_(self) -> str:
        """Gates as a table, for a notebook."""
        table = self.gates.to_html(index=False, float_format="{:.4g}".format, na_rep="")
        return f"<p>{escape(repr(self))}</p>\n{table}"


def suite_result(run: Run, report: Path | None) -> SuiteResult:
    """Run's scores, gates and records as tables."""
    return SuiteResult(
        name=run.suite.name,
        scores=pd.DataFrame([_score_row(score) for score in run.scores], columns=_SCORE),
        gates=pd.DataFrame([_gate_row(gate) for gate in run.gates], columns=_GATE),
        records=run.records,
        passed=run.passed,
        tally=tally(run.gates),
        report=report,
    )


_SCORE = [
    "name", "experiment", "method", "series", "measure", "statistic", "title",
    "value", "low", "high", "unit", "count", "counted", "better",
]  # fmt: skip
_GATE = ["score", "relation", "bound", "end", "found", "passed", "reason"]


def _score_row(score: Score) -> tuple[object, ...]:
    key = score.key
    return (
        *(score.name, key.experiment, key.method, key.series, key.measure, key.statistic),
        *(score.title, score.value, score.low, score.high),
        *(score.unit, score.count, score.counted, score.better),
    )


def _gate_row(result: GateResult) -> tuple[object, ...]:
    gate = result.gate
    return (
        *(gate.score, gate.relation, gate.bound, gate.end),
        *(result.found, result.passed, gate.reason),
    )
