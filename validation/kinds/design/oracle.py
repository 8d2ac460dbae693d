"""What one who knows the truth would measure in a designed experiment."""

import pandas as pd

from rockshape.method import methods
from validation.kinds.design.outlines import TRUTH_OF
from validation.kinds.design.work import CLEAN

_VIEW = ["experiment", "scene", "instance", "method", "view"]


def knowing(records: pd.DataFrame) -> pd.DataFrame:
    """Return records of designed experiments in which nothing but the view moves a rock's value.

    In every cell and state a measure of the outline is the true number of that view's outline. A
    measure of the solid has no truth of a view: it is the clean values' mean in that view.
    """
    fed = records.copy()
    view = [fed[name] for name in _VIEW]
    every = (one for method in methods().values() for one in method.measures)
    for column in dict.fromkeys(one.column for one in every):
        if column in fed:
            clean = fed[column].where(fed["series"] == CLEAN)
            source = fed[TRUTH_OF[column]] if column in TRUTH_OF else clean
            fed[column] = source.groupby(view, sort=False).transform("mean")
    return fed
