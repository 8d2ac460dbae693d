"""Sweeps: the order and the error of rocks' values while one key of their scene is turned."""

import math

import pandas as pd
from case import Case, Cell, Column, Table
from suites import chosen_suite, suite_scores

SUITES = ("distance", "noise", "resolution", "burial", "occlusion", "light")
TURNED = {
    "distance": "distance with stereo noise, m",
    "noise": "standard deviation of disparity, px",
    "resolution": "diameter with exact range, m",
    "burial": "buried share of the height",
    "occlusion": "spacing of the rocks under a low camera",
    "light": "the sun's elevation, degrees",
}
LEAST_COUNT = 50  # pairs or rocks that a score is of
READ = (
    ("sphericity_3d", "paper", "tau"),
    ("sphericity_3d", "robust", "tau"),
    ("sphericity_3d", "robust", "error"),
    ("angularity_2d_deg", "paper", "tau"),
    ("angularity_2d", "robust", "tau"),
    ("roundness", "robust", "view_tau"),
    ("angularity_3d", "robust", "tau"),
    ("axis_ratio", "robust", "view_error"),
)


def sweeps(*, suites: tuple[str, ...] = SUITES, preset: str = "", jobs: int = 2) -> list[Table]:
    """Run the sweeps and table what each step leaves of order and accuracy."""
    rows: list[tuple[Cell, ...]] = []
    for name in suites:
        sweep = chosen_suite(name).experiments[0].sweep
        scores = suite_scores(name, preset=preset, jobs=jobs)
        steps = [series for series in scores["series"].unique() if series]
        for value, step in zip(sweep.values, steps, strict=True):
            own = scores[scores["series"] == step]
            cells = (_cell(own, *read) for read in READ)
            rows.append((TURNED[name], _step(value), *cells))
    heads = (f"`{measure}`, {method}: {_WORD[statistic]}" for measure, method, statistic in READ)
    return [
        Table((Column("turned"), Column("to"), *(Column(head, "", ".2f") for head in heads)), rows)
    ]


_WORD = {
    "tau": "τ_b",
    "view_tau": "τ_b with the view's outline",
    "error": "error",
    "view_error": "error beside the view's outline",
}


def _step(value: float | tuple[float, ...]) -> str:
    """Return a value of the key, or the range that it is drawn from."""
    ends = value if isinstance(value, tuple) else (value,)
    return " to ".join(dict.fromkeys(f"{end:g}" for end in ends))


def _cell(scores: pd.DataFrame, measure: str, method: str, statistic: str) -> float | None:
    """Return a score; None where too little was answered."""
    found = scores[
        (scores["measure"] == measure)
        & (scores["method"] == method)
        & (scores["statistic"] == statistic)
        & (scores["count"] >= LEAST_COUNT)
    ]
    value = float(found["value"].iloc[0]) if len(found) else math.nan
    return value if math.isfinite(value) else None


SWEEPS_CASE = Case(
    name="sweeps",
    what="order and error of values while one key of the scene is turned, six suites",
    run=sweeps,
    smallest={"suites": ("burial",), "preset": "imp", "jobs": 1},
    slow=True,
)
