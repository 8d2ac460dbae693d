"""Judge of designed experiments: what moves a rock's value from view to view, and how much."""

from collections.abc import Sequence

from validation.kinds.design.judge.definitions import definitions
from validation.kinds.design.judge.oracle import FEEDS
from validation.kinds.design.spec import DesignExperiment
from validation.peers import MeasureSpec
from validation.scores.expectations import Claim

__all__ = ["FEEDS", "claims", "definitions", "ranked_claims", "view_claims"]


def claims(
    _experiment: DesignExperiment,
    _measures: Sequence[MeasureSpec],
) -> tuple[Claim, ...]:
    """None: a design asks what moves values, not what they are."""
    return ()


view_claims = ranked_claims = claims
