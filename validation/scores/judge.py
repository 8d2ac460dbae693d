"""Judge of a kind: its claims, its scores, and what a measurer of known verdict would find."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Protocol, TypeVar, cast

import numpy as np
import pandas as pd

from validation.peers import MeasureSpec
from validation.scores.expectations import Claim
from validation.scores.score import Definition
from validation.suite.experiment import Experiment
from validation.suite.kind import Kind
from validation.suite.registry import kind_of

Measures = Sequence[MeasureSpec]
E_contra = TypeVar("E_contra", bound=Experiment, contravariant=True)


@dataclass(frozen=True)
class Feeds:
    """Records of one experiment as measurers of known verdict would leave them.

    `oracle` knows the truth and must pass every gate; `shuffled` has the truth of other rocks,
    `mixed` the values of other rocks, and must not. All take the claims of the whole suite.
    """

    oracle: Callable[[pd.DataFrame, Sequence[Claim]], pd.DataFrame]
    shuffled: Callable[[pd.DataFrame, np.random.Generator], pd.DataFrame]  # of the oracle's
    mixed: Callable[[pd.DataFrame, Sequence[Claim], np.random.Generator], pd.DataFrame]


class Judge(Protocol[E_contra]):
    """Module of a kind that says what its records amount to."""

    @property
    def FEEDS(self) -> Feeds:  # noqa: N802 (a constant of a module)
        """Measurers of known verdict."""

    def claims(self, experiment: E_contra, measures: Measures, /) -> tuple[Claim, ...]:
        """Trait that each column is expected to rise with, held to the truth of the rocks."""

    def view_claims(self, experiment: E_contra, measures: Measures, /) -> tuple[Claim, ...]:
        """Trait that each column is expected to rise with, held to what each view truly shows."""

    def ranked_claims(self, experiment: E_contra, measures: Measures, /) -> tuple[Claim, ...]:
        """Claims whose columns the leaderboard ranks."""

    def definitions(self, experiment: E_contra, measures: Measures, /) -> tuple[Definition, ...]:
        """Scores; they are known before anything is measured."""


def judge_of_kind(kind: Kind) -> Judge[Experiment]:
    """Import the judge of a kind."""
    return cast(Judge[Experiment], import_module(kind.judge))


def judge_of(experiment: Experiment) -> Judge[Experiment]:
    """Import the judge of an experiment's kind."""
    return judge_of_kind(kind_of(experiment))
