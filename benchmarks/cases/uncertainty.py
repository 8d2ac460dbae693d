"""Coverage and width of the 90 % intervals on families left out in turn, scans and photographs."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import astuple

import numpy as np
import pandas as pd
from case import Case, Cell, Column, Table
from held_out_rocks import PHOTOGRAPH, PHOTOGRAPHS, SCAN, made_and_scanned, photograph_pairs
from scipy.stats import norm

from rockshape.measurement import AXES
from rockshape.method import ROBUST
from rockshape.numerics.arrays import Floats
from rockshape.uncertainty import COVERAGE, ErrorModels, estimates, read_error_models
from rockshape.uncertainty.error_model import decode_models
from training.uncertainty.fit import LEFT_OUT, known_pairs, value_names
from training.uncertainty.pairs import FOUND, GIVEN, NO_RANGE
from training.uncertainty.scenes import FAMILIES
from training.uncertainty.table import observables_of

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
    "hidden by others": (
        ("up to 0.02", "hidden", -1, 0.02),
        ("0.02 to 0.1", "hidden", 0.02, 0.1),
        ("0.1 to 0.3", "hidden", 0.1, 0.3),
        ("more", "hidden", 0.3, 1.1),
    ),
}
LEVELS = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99)
TAIL = (1 - COVERAGE) / 2


def intervals(*, families: int = 66, scans: int = 66, jobs: int = 2) -> list[Table]:
    """Make scenes of families and of scans, measure, and hold each interval to the true value."""
    return tables(_held_to_truth(made_and_scanned(families, scans, GIVEN, jobs=jobs)))


def found_intervals(
    *, families: int = 44, scans: int = 33, photographs: int = 8, jobs: int = 2
) -> list[Table]:
    """The same of rocks that are found, and of those of photographs.

    A photograph's rocks are held to what is measured of the outlines that a person drew.
    """
    pairs = [
        made_and_scanned(families, scans, FOUND, jobs=jobs),
        *(photograph_pairs(name) for name in PHOTOGRAPHS[:photographs]),
    ]
    return tables(_held_to_truth(pd.concat(pairs, ignore_index=True)))


def _held_to_truth(pairs: pd.DataFrame) -> pd.DataFrame:
    """Interval of each value of each pair, beside the truth."""
    models = models_of_families()
    return pd.concat([_held(pairs, name, models) for name in value_names(pairs)])


def models_of_families() -> dict[str, ErrorModels]:
    """Error models by a rock's family: fitted to all others, and of real rocks the package's."""
    left_out = json.loads(LEFT_OUT.read_text(encoding="utf-8"))
    models = {
        family: decode_models(json.dumps(each).encode(), where=LEFT_OUT.name)
        for family, each in left_out.items()
    }
    return models | dict.fromkeys((SCAN, PHOTOGRAPH), read_error_models())


def tables(held: pd.DataFrame) -> list[Table]:
    """Tables by value, stratum, family and level of `held`, a row an interval."""
    return [_by_value(held), _by_stratum(held), _by_family(held), _by_level(held)]


def _held(pairs: pd.DataFrame, name: str, models: Mapping[str, ErrorModels]) -> pd.DataFrame:
    """Intervals of one value beside the truth, all over the truth for an axis."""
    known = known_pairs(pairs, name)
    families, values = known["family"].tolist(), known[f"value_{name}"].tolist()
    found = [
        astuple(estimates({name: value}, seen, models[family].of(seen), ROBUST.value_ranges)[name])
        for family, value, seen in zip(families, values, observables_of(known), strict=True)
    ]
    held = pd.DataFrame(found, columns=["sd", "low", "high"], index=known.index)
    held[["value", "truth"]] = known[[f"value_{name}", f"truth_{name}"]]
    if name in AXES:
        held = held.div(held["truth"], axis=0)
    held = held.dropna(subset=["low"])  # of a rock of which much is hidden
    kept = known.filter(regex="^(set|family|seen_.*|distance_m|buried|hidden)$")
    kept["seen_noise"] = kept["seen_noise"].where(known["range_kind"] != NO_RANGE)
    return kept.join(held, how="inner").assign(name=name)


def _score(low: Floats, high: Floats, truth: Floats) -> float:
    """Mean interval score: the width, and 2/α for what lies outside.

    Source: Gneiting and Raftery (2007), equation 43.
    """
    outside = np.maximum(low - truth, 0) + np.maximum(truth - high, 0)
    return float(np.mean(high - low + outside / TAIL))


def _constant(value: Floats, truth: Floats, *, relative: bool) -> float:
    """Least score of intervals of one width: the error's own quantiles.

    Of relative values it is one width of the logarithm.
    """
    if relative:
        low, high = np.quantile(np.log(value / truth), [TAIL, 1 - TAIL])
        return _score(value * np.exp(-high), value * np.exp(-low), truth)
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
                1 - _score(low, high, truth) / _constant(value, truth, relative=name in AXES),
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
            rows.append((what, told, *_coverage(held[inside])))
    return Table((Column("stratum"), Column("rocks"), *COVERAGES), rows, name="strata")


def _by_family(held: pd.DataFrame) -> Table:
    """Coverage by family; scans and photographs are the last."""
    names = [name for name in (*FAMILIES, SCAN, PHOTOGRAPH) if (held["family"] == name).any()]
    rows = [(name, *_coverage(held[held["family"] == name])) for name in names]
    return Table((Column("family"), *COVERAGES), rows, name="families")


COVERAGES = (
    Column("values", "", "d"),
    Column("coverage", "", ".2f"),
    Column("least of any value", "", ".2f"),
    Column("of"),
)


def _coverage(part: pd.DataFrame) -> tuple[Cell, ...]:
    """Number of intervals, their coverage, and the least that one measure's have."""
    if not len(part):
        return 0, None, None, ""
    within = (part["low"] <= part["truth"]) & (part["truth"] <= part["high"])
    least = within.groupby(part["name"]).mean()
    return len(part), float(within.mean()), float(least.min()), f"`{least.idxmin()}`"


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
    what="coverage and width of the 90 % intervals on families left out and on scans",
    run=intervals,
    smallest={"families": 2, "scans": 1, "jobs": 1},
    slow=True,
)

FOUND_UNCERTAINTY_CASE = Case(
    name="found_uncertainty",
    what="coverage and width of the 90 % intervals of rocks that are found, on photographs too",
    run=found_intervals,
    smallest={"families": 2, "scans": 1, "photographs": 1, "jobs": 1},
    slow=True,
)
