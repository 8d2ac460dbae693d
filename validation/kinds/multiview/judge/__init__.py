"""Judge of multi-view experiments: claims on rocks and on views, and their scores."""

from validation.kinds.multiview.judge.definitions import (
    claims,
    definitions,
    ranked_claims,
    view_claims,
)
from validation.selfcheck.feeds import CLAIMED as FEEDS

__all__ = ["FEEDS", "claims", "definitions", "ranked_claims", "view_claims"]
