"""Gates: a score, a bound and a reason; what misses its bound fails the run."""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Literal, NamedTuple

from msgspec import Meta, Struct

from validation.errors import InputError

Text = Annotated[str, Meta(min_length=1)]
End = Literal["value", "low", "high"]


class ScoreValue(NamedTuple):
    """What a score came to, and its interval; NaN where there is none."""

    value: float
    low: float = math.nan
    high: float = math.nan


class Gate(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One bound on one score, with the reason why it stands where it stands.

    `end` says what must clear the bound: the value itself, or an end of its 95 % interval. `low`
    with at_least (`high` with at_most) passes only what is sure; the other end fails only what is
    surely wrong.
    """

    score: Text
    at_least: float | None = None
    at_most: float | None = None
    end: End = "value"
    reason: Text

    def __post_init__(self) -> None:
        """Ask for exactly one finite bound."""
        bounds = [bound for bound in (self.at_least, self.at_most) if bound is not None]
        if len(bounds) != 1 or not math.isfinite(bounds[0]):
            raise ValueError(
                f"gate {self.score!r}: expected one finite number, at_least or at_most, "
                f"found {bounds or 'neither'}"
            )

    @property
    def bound(self) -> float:
        """The number to reach or not to pass."""
        if self.at_least is not None:
            return self.at_least
        return math.nan if self.at_most is None else self.at_most

    @property
    def relation(self) -> str:
        """≥ or ≤."""
        return "≥" if self.at_least is not None else "≤"


class GateFile(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A file of gates alone, for `--gates`."""

    gate: Annotated[tuple[Gate, ...], Meta(min_length=1)]


def gates_on(gates: Sequence[Gate], known: Collection[str]) -> tuple[Gate, ...]:
    """Gates whose scores are known: those of the methods that are run."""
    return tuple(gate for gate in gates if gate.score in known)


@dataclass(frozen=True)
class GateResult:
    """A gate and the number it met, the value or an end; NaN where there was none."""

    gate: Gate
    found: float
    passed: bool


def check_names(gates: Sequence[Gate], known: Collection[str], *, where: str) -> None:
    """Refuse a gate on a score that the suite does not have.

    Raises:
        InputError: names the file, the gate and the scores that come closest.
    """
    for index, gate in enumerate(gates):
        if gate.score in known:
            continue
        prefix = gate.score.rpartition(".")[0]
        near = sorted(name for name in known if prefix and name.startswith(prefix + "."))
        expected = ", ".join(near or sorted(known))
        raise InputError(
            f"{where}: gate[{index}].score: expected one of {expected}, found {gate.score!r}"
        )


def evaluate(gates: Sequence[Gate], scores: Mapping[str, ScoreValue]) -> tuple[GateResult, ...]:
    """Hold each gate against its score. A score or end that is missing or NaN fails."""
    results = []
    for gate in gates:
        score = scores.get(gate.score, ScoreValue(math.nan))
        found = {"value": score.value, "low": score.low, "high": score.high}[gate.end]
        passed = found >= gate.bound if gate.at_least is not None else found <= gate.bound
        results.append(GateResult(gate=gate, found=found, passed=passed))
    return tuple(results)


def tally(results: Collection[GateResult]) -> str:
    """Count of gates in words: `1 of 4 gates failed`, or `4 of 4 gates passed`."""
    failed = sum(not result.passed for result in results)
    verdict = "failed" if failed else "passed"
    return f"{failed or len(results)} of {len(results)} gates {verdict}"
