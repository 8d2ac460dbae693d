"""The gates held to themselves: on records whose verdict is known before."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from validation.scores.expectations import Claim
from validation.scores.score import VIEW_PREFIX
from validation.scores.scoring import all_claims, all_view_claims, gate_scores
from validation.selfcheck.oracle import mixed, oracle, shuffled
from validation.suite.gates import Gate, GateResult, evaluate
from validation.suite.suite import Suite

SHUFFLE_SEED = 6

_Feed = Callable[[Sequence[Claim]], pd.DataFrame]


@dataclass(frozen=True)
class Check:
    """The suite's own gates on records whose verdict is known before."""

    name: str
    fed: str  # what was fed in, in words
    knows: bool  # whether it knows the truth, and must pass every gate, or must not
    gates: tuple[GateResult, ...]

    @property
    def passes(self) -> tuple[str, ...]:
        """The scores whose gates it passed."""
        return tuple(result.gate.score for result in self.gates if result.passed)

    @property
    def sound(self) -> bool:
        """Whether the verdict is the one it must be."""
        return (len(self.passes) == len(self.gates)) == self.knows


def _statistic(gate: Gate) -> str:
    return gate.score.rpartition(".")[2]


def _gated(suite: Suite, gates: Sequence[Gate], feed: _Feed) -> tuple[GateResult, ...]:
    """Hold fed records to the gates: those on rocks fed by the rocks' truths, the rest by views'.

    A column has both claims, and cannot be both truths at once.
    """
    of_view = [gate for gate in gates if _statistic(gate).startswith(VIEW_PREFIX)]
    of_rock = [gate for gate in gates if gate not in of_view]
    return tuple(
        result
        for held, claims in ((of_rock, all_claims(suite)), (of_view, all_view_claims(suite)))
        if held
        for result in evaluate(held, gate_scores(suite, held, feed(claims)))
    )


def self_checks(suite: Suite, gates: Sequence[Gate], records: pd.DataFrame) -> tuple[Check, ...]:
    """What the gates say of the truth, of other rocks' truth and of other rocks' values.

    Gates on a level are left out: the truth is not in the measure's unit. Without any other there
    is no check.
    """
    checked = [gate for gate in gates if _statistic(gate) != "level"]
    if not checked:
        return ()
    rng = np.random.default_rng(SHUFFLE_SEED)
    feeds: tuple[tuple[str, str, bool, _Feed], ...] = (
        ("oracle", "the truth as measurement", True, lambda claims: oracle(records, claims)),
        (
            "shuffled",
            "the truth of other rocks",
            False,
            lambda claims: shuffled(records, claims, rng=rng),
        ),
        (
            "mixed",
            "the values of other rocks",
            False,
            lambda claims: mixed(records, claims, rng=rng),
        ),
    )
    return tuple(
        Check(name, fed, knows, _gated(suite, checked, feed)) for name, fed, knows, feed in feeds
    )
