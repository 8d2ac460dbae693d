"""A run's scores and gates for machines; it holds no time and no place, so equal runs are equal."""

import json
import math

import msgspec

from validation.execution.recorded import FORMAT
from validation.execution.run import Run
from validation.paper.statistics import paper_values
from validation.report.provenance import seeds, versions
from validation.scores.score import Score
from validation.suite.gates import GateResult


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _score(score: Score) -> dict[str, object]:
    return {
        "name": score.name,
        "experiment": score.key.experiment,
        "method": score.key.method,
        "series": score.key.series,
        "measure": score.key.measure,
        "statistic": score.key.statistic,
        "title": score.title,
        "value": _number(score.value),
        "unit": score.unit,
        "count": score.count,
        "counted": score.counted,
        "better": score.better,
        "low": _number(score.low),
        "high": _number(score.high),
        "p": _number(score.p),
    }


def _gate(result: GateResult) -> dict[str, object]:
    return {
        "score": result.gate.score,
        "at_least": result.gate.at_least,
        "at_most": result.gate.at_most,
        "end": result.gate.end,
        "reason": result.gate.reason,
        "found": _number(result.found),
        "passed": result.passed,
    }


def scores_json(run: Run) -> str:
    """JSON text; a value that does not exist is null."""
    document = {
        "format": FORMAT,
        "suite": run.suite.name,
        "spec": msgspec.to_builtins(run.suite),
        "passed": run.passed,
        "backend": run.backend,
        "seeds": seeds(run),
        "versions": versions(),
        "scores": [_score(score) for score in run.scores],
        "gates": [_gate(result) for result in run.gates],
        "paper": {
            measure: {key: _number(value) for key, value in values.items()}
            for measure, values in paper_values().items()
        },
        "self_check": {
            check.name: {"sound": check.sound, "passes": check.passes} for check in run.checks
        },
    }
    return (
        json.dumps(document, indent=1, sort_keys=True, allow_nan=False, ensure_ascii=False) + "\n"
    )
