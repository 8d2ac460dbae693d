"""Measurers of known verdict: one that knows the truth and two that know nothing.

They go through the same scoring and the same gates as a real run. If the oracle failed a gate, or
one of the others passed them all, the gates would be wrong and not the measures. Gates on a level
are left out: the truth has no degrees.
"""

from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd

from validation.scores.expectations import Claim
from validation.scores.judge import Feeds, judge_of_kind
from validation.suite.registry import kind_named


def _by_experiment(
    records: pd.DataFrame, feed: Callable[[Feeds, pd.DataFrame], pd.DataFrame]
) -> pd.DataFrame:
    """All records, each experiment's as its kind feeds them, in the order that they had."""
    parts = [
        feed(judge_of_kind(kind_named(str(own["kind"].iloc[0]))).FEEDS, own)
        for _, own in records.groupby("experiment", sort=True)
    ]
    return pd.concat(parts).sort_index()


def oracle(records: pd.DataFrame, claims: Sequence[Claim]) -> pd.DataFrame:
    """Records in which every rock is found and every measure is the truth it claims."""
    return _by_experiment(records, lambda feeds, own: feeds.oracle(own, claims))


def shuffled(
    records: pd.DataFrame, claims: Sequence[Claim], *, rng: np.random.Generator
) -> pd.DataFrame:
    """Oracle's records with the truth of other rocks, or where none is claimed, lost."""
    return _by_experiment(oracle(records, claims), lambda feeds, own: feeds.shuffled(own, rng))


def mixed(
    records: pd.DataFrame, claims: Sequence[Claim], *, rng: np.random.Generator
) -> pd.DataFrame:
    """Records with the values of other rocks, or where none is claimed, lost."""
    return _by_experiment(records, lambda feeds, own: feeds.mixed(own, claims, rng))
