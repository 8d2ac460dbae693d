"""Outcome of a suite as plain values, and its text in a failing test."""

import math

from msgspec import Struct

from validation.report.format import interval, number
from validation.scores.score import Score
from validation.suite.gates import Gate

_ASCII = {"≥": ">=", "≤": "<="}
_ENDS = {"value": "", "low": "low end of the interval ", "high": "high end of the interval "}


class GateOutcome(Struct, frozen=True, kw_only=True):
    """A gate with its score."""

    gate: Gate
    score: Score
    passed: bool

    def properties(self) -> list[tuple[str, object]]:
        """Properties of a test report, as JUnit has them."""
        numbers = {"value": self.score.value, "low": self.score.low, "high": self.score.high}
        return [
            ("score", self.gate.score),
            ("bound", f"{self.gate.relation} {self.gate.bound:g}"),
            *((name, f"{value:.6g}") for name, value in numbers.items() if math.isfinite(value)),
            ("reason", self.gate.reason),
        ]

    def __str__(self) -> str:
        """Lines of a failure: score, bound, value, interval and reason."""
        gate = self.gate
        lines = {
            "expected": f"{_ENDS[gate.end]}{gate.relation} {number(gate.bound)}",
            "found": number(self.score.value) if math.isfinite(self.score.value) else "no value",
            "interval": interval(self.score.low, self.score.high) or "none",
            "reason": gate.reason,
        }
        told = [f"gate failed: {gate.score}", f"  {self.score.title}"]
        return "\n".join([*told, *(f"  {name:<9} {text}" for name, text in lines.items())])


class Outcome(Struct, frozen=True, kw_only=True):
    """What a suite came to, or the line that says why it cannot run."""

    suite: str
    gates: tuple[GateOutcome, ...] = ()
    error: str = ""
    warnings: tuple[str, ...] = ()  # of the self-checks
    units: int = 0
    cached: int = 0  # of the units
    seconds: float = 0.0
    report: str = ""  # folder, where one is written

    def summary(self) -> list[str]:
        """Lines for the end of a session."""
        if self.error:
            return []
        passed = sum(gate.passed for gate in self.gates)
        cached = f", {self.cached} of {self.units} units from the cache" if self.cached else ""
        page = f"; {self.report}/index.html" if self.report else ""
        gates = f"{passed} of {len(self.gates)} gates passed"
        return [
            f"suite {self.suite}: {gates} in {self.seconds:.1f} s{cached}{page}",
            *(f"suite {self.suite}: warning: {text}" for text in self.warnings),
        ]


class GateError(AssertionError):
    """A score that misses its bound."""

    def __init__(self, outcome: GateOutcome) -> None:
        """Tell what the gate found."""
        super().__init__(str(outcome))


class SuiteError(RuntimeError):
    """A suite that cannot run; the message says why in one line."""


def gate_name(gate: Gate) -> str:
    """Name of a gate's test: its score, relation and bound, as `yard.recall>=0.95`."""
    score = gate.score if gate.end == "value" else f"{gate.score}.{gate.end}"
    return f"{score}{_ASCII[gate.relation]}{gate.bound:g}"
