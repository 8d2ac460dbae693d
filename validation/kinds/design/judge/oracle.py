"""Measurers of known verdict on a designed experiment."""

from collections.abc import Sequence

import pandas as pd

from rockshape.method import methods
from validation.kinds.design.spec import CLEAN
from validation.scores.expectations import TRUTH, Claim
from validation.scores.judge import Feeds
from validation.selfcheck.feeds import found_all, missed_all

_VIEW = ["experiment", "scene", "instance", "method", "view"]


def knowing(records: pd.DataFrame, _claims: Sequence[Claim] = ()) -> pd.DataFrame:
    """Records of a designed experiment in which nothing but the view moves a rock's value.

    In every cell and state a measure of the outline is the truth of that view's outline. A measure
    of the solid has no truth of a view: it is the clean values' mean in that view.
    """
    fed = found_all(records)
    view = [fed[name] for name in _VIEW]
    truths = {m.column: m.view_truth for method in methods().values() for m in method.measures}
    for column in truths.keys() & set(fed.columns):
        truth = TRUTH + truths[column]
        known = truths[column] and truth in fed
        source = fed[truth] if known else fed[column].where(fed["series"] == CLEAN)
        fed[column] = source.groupby(view, sort=False).transform("mean")
    return fed


FEEDS = Feeds(
    oracle=knowing,
    shuffled=lambda records, _rng: missed_all(records),
    mixed=lambda records, _claims, _rng: missed_all(records),
)
