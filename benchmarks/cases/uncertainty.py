"""Coverage and width of the 90 % intervals on rocks, families and scans held out."""

from collections.abc import Mapping, Sequence
from dataclasses import astuple
from pathlib import Path

import numpy as np
import pandas as pd
from case import Case, Cell, Column, Table
from scipy.stats import norm

from rockshape.measurement import AXES
from rockshape.method import ROBUST
from rockshape.numerics.arrays import Floats
from rockshape.uncertainty import COVERAGE, estimates, read_error_model
from training.uncertainty.fit import value_names
from training.uncertainty.pairs import HELD_OUT, TAUGHT
from training.uncertainty.table import PairSet, observables_of, pair_table

# held out: the form was developed on apollo_sample 1, 3, 4, 7, 8 and 17
SCANS = tuple(
    sorted(str(each) for each in (Path(__file__).parents[2] / "examples" / "rocks").glob("*.ply"))
)
SETS = (
    PairSet("families taught", 10_000, 24, TAUGHT),
    PairSet("families held out", 10_100, 24, HELD_OUT),
    PairSet("scans", 10_200, 24, ("scan",), SCANS),
)
STRATA: Mapping[str, Sequence[tuple[str, str, float, float]]] = {
    "width": (
        ("12 to 25 px", "seen_width_px", 12, 25),
        ("25 to 50 px", "seen_width_px", 25, 50),
        ("50 px and more", "seen_width_px", 50, np.inf),
    ),
    "range": (
        ("exact", "seen_noise", -1, 1e-3),
        ("noise up to 0.05 of the width", "seen_noise", 1e-3, 0.05),
        ("noise above", "seen_noise", 0.05, np.inf),
    ),
    "distance": (
        ("up to 3 m", "distance_m", 0, 3),
        ("farther", "distance_m", 3, np.inf),
    ),
    "burial": (
        ("on the ground", "buried", -1, 0.02),
        ("sunk", "buried", 0.02, 1.1),
    ),
}
LEVELS = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99)
TAIL = (1 - COVERAGE) / 2


def intervals(*, sets: Sequence[PairSet] = SETS, jobs: int = 2) -> list[Table]:
    """Make the sets, measure, and hold each interval to the true value."""
    pairs = pd.concat([pair_table(one, jobs=jobs) for one in sets], ignore_index=True)
    return tables(pd.concat([_held(pairs, name) for name in value_names(pairs)]))


def tables(held: pd.DataFrame) -> list[Table]:
    """Tables by value, stratum and level of `held`, a row an interval."""
    return [_by_value(held), _by_stratum(held), _by_level(held)]


def _held(pairs: pd.DataFrame, name: str) -> pd.DataFrame:
    """Intervals of one value beside the truth, both over the truth for an axis."""
    known = pairs[np.isfinite(pairs[f"value_{name}"]) & np.isfinite(pairs[f"truth_{name}"])]
    models, ranges = read_error_model(), ROBUST.value_ranges
    found = [
        astuple(estimates({name: value}, seen, models, ranges)[name])
        for value, seen in zip(known[f"value_{name}"], observables_of(known), strict=True)
    ]
    held = pd.DataFrame(found, columns=["sd", "low", "high"], index=known.index)
    held[["value", "truth"]] = known[[f"value_{name}", f"truth_{name}"]]
    if name in AXES:
        held = held.div(held["truth"], axis=0)
    return known.filter(regex="^(set|seen_.*|distance_m|buried)$").join(held).assign(name=name)


def _score(low: Floats, high: Floats, truth: Floats) -> float:
    """Mean interval score: the width, and 2/α for what lies outside.

    Source: Gneiting and Raftery (2007), equation 43.
    """
    outside = np.maximum(low - truth, 0) + np.maximum(truth - high, 0)
    return float(np.mean(high - low + outside / TAIL))


def _constant(value: Floats, truth: Floats) -> float:
    """Least score of intervals of one width: the error's own quantiles."""
    low, high = np.quantile(value - truth, [TAIL, 1 - TAIL])
    return _score(value - high, value - low, truth)


def _by_value(held: pd.DataFrame) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for (name, which), part in held.groupby(["name", "set"], sort=False):
        low, high, truth, value = (
            part[each].to_numpy() for each in ("low", "high", "truth", "value")
        )
        spread = np.ptp(np.quantile(truth, [TAIL, 1 - TAIL])) if name not in AXES else None
        width = float(np.median(high - low))
        rows.append(
            (
                f"`{name}`",
                which,
                len(part),
                float(np.mean((low <= truth) & (truth <= high))),
                width,
                None if spread is None else width / spread,
                1 - _score(low, high, truth) / _constant(value, truth),
            )
        )
    columns = (
        Column("value"),
        Column("rocks"),
        Column("values", "", "d"),
        Column("coverage", "", ".2f"),
        Column("median width"),
        Column("over the spread of the rocks", "", ".2f"),
        Column("interval score below one width's", "", "+.0%"),
    )
    return Table(columns, rows, name="values")


def _by_stratum(held: pd.DataFrame) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for what, strata in STRATA.items():
        for told, column, low, high in strata:
            inside = (held[column] >= low) & (held[column] < high)
            part = held[inside]
            within = (part["low"] <= part["truth"]) & (part["truth"] <= part["high"])
            least = within.groupby(part["name"]).mean()
            rows.append(
                (
                    what,
                    told,
                    len(part),
                    float(within.mean()) if len(part) else None,
                    float(least.min()) if len(part) else None,
                    f"`{least.idxmin()}`" if len(part) else "",
                )
            )
    columns = (
        Column("stratum"),
        Column("rocks"),
        Column("values", "", "d"),
        Column("coverage", "", ".2f"),
        Column("least of any value", "", ".2f"),
        Column("of"),
    )
    return Table(columns, rows, name="strata")


def _by_level(held: pd.DataFrame) -> Table:
    """Share of true values within z standard deviations, beside a normal distribution's."""
    off = (held["value"] - held["truth"]).abs() / held["sd"]
    sets = held["set"].unique().tolist()
    rows = [
        (
            level,
            *(float((off <= norm.ppf((1 + level) / 2))[held["set"] == one].mean()) for one in sets),
        )
        for level in LEVELS
    ]
    columns = (Column("normal errors", "", ".2f"), *(Column(one, "", ".2f") for one in sets))
    return Table(columns, rows, name="levels")


UNCERTAINTY_CASE = Case(
    name="uncertainty",
    what="coverage and width of the 90 % intervals on rocks held out",
    run=intervals,
    smallest={"sets": (PairSet("families taught", 10_000, 2, TAUGHT),), "jobs": 1},
    slow=True,
)
