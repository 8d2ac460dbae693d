"""Judge of segmentations: objects found, how well their masks fit, and the ground under them."""

from collections.abc import Sequence

from validation.kinds.segmentation.judge.definitions import definitions
from validation.kinds.segmentation.judge.oracle import FEEDS
from validation.kinds.segmentation.spec import SegmentationExperiment
from validation.peers import MeasureSpec
from validation.scores.expectations import Claim

__all__ = ["FEEDS", "claims", "definitions", "ranked_claims", "view_claims"]


def claims(
    _experiment: SegmentationExperiment,
    _measures: Sequence[MeasureSpec],
) -> tuple[Claim, ...]:
    """None: a segmentation measures nothing."""
    return ()


view_claims = ranked_claims = claims
