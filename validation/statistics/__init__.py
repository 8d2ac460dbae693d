"""How well values agree with a true order, and with themselves from another view.

Every function takes one `Block` or a sequence of them, so that the paper's tables and our scenes
go through the same code.
"""

from validation.statistics.block import Block
from validation.statistics.concordance import concordance, kendall_w
from validation.statistics.correlation import IntraclassCorrelation, intraclass_correlation
from validation.statistics.pairs import (
    Pairs,
    across_views,
    between_views,
    share_in_order,
    tau_b,
    weighted_share_in_order,
    weighted_tau_b,
    within_views,
)
from validation.statistics.spread import spreads_over_views, weighted_within_over_between
from validation.statistics.variation import (
    coefficients_of_variation,
    divide_by_view_means,
    rank_moves,
)

__all__ = [
    "Block",
    "IntraclassCorrelation",
    "Pairs",
    "across_views",
    "between_views",
    "coefficients_of_variation",
    "concordance",
    "divide_by_view_means",
    "intraclass_correlation",
    "kendall_w",
    "rank_moves",
    "share_in_order",
    "spreads_over_views",
    "tau_b",
    "weighted_share_in_order",
    "weighted_tau_b",
    "weighted_within_over_between",
    "within_views",
]
