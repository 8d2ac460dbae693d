"""Claims and scores of frames: whether the paper's orders of its named rocks come out."""

from collections.abc import Sequence

import numpy as np

from validation.kinds.frames.spec import FramesExperiment
from validation.kinds.frames.statements import STATEMENTS
from validation.kinds.frames.work import PLACE
from validation.peers import MeasureSpec
from validation.scores.agreement import Statistic
from validation.scores.define import define
from validation.scores.expectations import Claim
from validation.scores.score import Definition, Estimate
from validation.scores.titles import column_of
from validation.selfcheck.feeds import CLAIMED as FEEDS
from validation.statistics import Block, share_in_order, within_views

__all__ = ["FEEDS", "claims", "definitions", "ranked_claims", "view_claims"]


def _held(blocks: Sequence[Block]) -> Estimate:
    pairs = within_views(blocks)
    return Estimate(share_in_order(pairs), pairs.decided)


def _answered(blocks: Sequence[Block]) -> Estimate:
    """Share of the stated pairs of which both rocks have a value."""
    stated = sum(
        int(np.count_nonzero(np.triu(block.truth[:, None] != block.truth))) for block in blocks
    )
    answered = within_views(blocks).decided
    return Estimate(answered / stated if stated else float("nan"), stated)


STATISTICS = (
    Statistic("held", "stated pairs in order", "share", "pairs", "higher", _held),
    Statistic("answered", "stated pairs with two values", "share", "pairs", "higher", _answered),
)


def claims(
    experiment: FramesExperiment,
    _measures: Sequence[MeasureSpec],
) -> tuple[Claim, ...]:
    """Claims of each measure of the paper, by each method, on the places that the paper gives."""
    return tuple(
        Claim(experiment.name, "", method, column_of(method, stated), PLACE + stated)
        for method in experiment.methods
        for stated in dict.fromkeys(statement.measure for statement in STATEMENTS)
    )


def view_claims(
    _experiment: FramesExperiment,
    _measures: Sequence[MeasureSpec],
) -> tuple[Claim, ...]:
    """None: what a frame truly shows is not known."""
    return ()


ranked_claims = view_claims


def definitions(
    experiment: FramesExperiment, measures: Sequence[MeasureSpec]
) -> tuple[Definition, ...]:
    """Scores of the statements, by method and measure."""
    return tuple(
        define(claim, statistic)
        for claim in claims(experiment, measures)
        for statistic in STATISTICS
    )
