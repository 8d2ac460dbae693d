"""Order of values that are refused as not resolvable, had they been given."""

from contextlib import ExitStack
from dataclasses import dataclass
from unittest import mock

import msgspec
import numpy as np
import pandas as pd
from case import Case, Cell, Column, Table
from limit_scores import scored
from suites import chosen_suite

from rockshape.measures import ellipsoid_error, roughness_3d
from validation.execution.units import units_of
from validation.execution.work import run_unit
from validation.scores.blocks import blocks_of
from validation.scores.expectations import Claim

DISPARITY_PX = (0.1, 0.2, 0.32, 0.6)
ROUGHNESS = roughness_3d.ROBUST.column
_ROCK = ["scene", "view", "instance"]


@dataclass(frozen=True)
class Refused:
    """A value that noise can hide, on an experiment that varies what it tells."""

    suite: str  # and experiment
    column: str
    truth: str


REFUSED = (
    Refused("noise", ellipsoid_error.ROBUST.column, "truth_angularity"),
    Refused("noise", ROUGHNESS, "truth_angularity"),
    Refused("relief", ROUGHNESS, "truth_roughness"),
)


def refusals(
    *,
    suites: tuple[str, ...] = ("noise", "relief"),
    disparity_px: tuple[float, ...] = DISPARITY_PX,
    preset: str = "",
) -> list[Table]:
    """Hold values that are refused in noise to the truth, beside those that are given."""
    rows: list[tuple[Cell, ...]] = []
    for suite in suites:
        as_is = _records(suite, disparity_px, preset)
        with ExitStack() as changed:
            changed.enter_context(mock.patch.object(ellipsoid_error, "MAX_NOISE", np.inf))
            changed.enter_context(mock.patch.object(roughness_3d, "MAX_NOISE_SHARE", np.inf))
            ungated = _records(suite, disparity_px, preset)
        for one in REFUSED:
            if one.suite == suite:
                rows += [_row(one, step, as_is[step], ungated[step]) for step in as_is]
    columns = [Column("value"), Column("suite"), Column("σ_d, px"), Column("refused", "%", ".0f")]
    for words in ("given: order, τ", "refused: order, τ"):
        columns += [Column(words, "", ".2f"), Column("95 %"), Column("pairs", "", "d")]
    return [Table(tuple(columns), rows)]


def _records(name: str, disparity_px: tuple[float, ...], preset: str) -> dict[str, pd.DataFrame]:
    """Records of the rocks of a suite's experiment of its name, by the noise's step."""
    suite = chosen_suite(name, only=(name,), preset=preset)
    (experiment,) = suite.experiments
    swept = msgspec.structs.replace(
        experiment,
        methods=("robust",),
        sweep=msgspec.structs.replace(
            experiment.sweep, key="noise.disparity_px", values=disparity_px
        ),
    )
    suite = msgspec.structs.replace(suite, experiments=(swept,))
    whole = pd.concat([run_unit(unit).records for unit in units_of(suite)], ignore_index=True)
    whole = whole[whole["status"] != "extra"]
    return {step: whole[whole["series"] == step].set_index(_ROCK) for step in swept.series}


def _row(one: Refused, step: str, as_is: pd.DataFrame, ungated: pd.DataFrame) -> tuple[Cell, ...]:
    value = ungated[one.column]
    refused = as_is[one.column].isna() & value.notna()
    cells: list[Cell] = []
    for kept in (~refused, refused):
        records = ungated.assign(**{one.column: value.where(kept)}).reset_index()
        blocks = blocks_of(records, Claim(one.suite, step, "robust", one.column, one.truth))
        tau = scored("tau", blocks, name=f"{one.suite}.robust.{step}.{one.column}")
        interval = "–" if tau.interval == "–" else f"{tau.low:.2f} … {tau.high:.2f}"
        cells += (tau.value if np.isfinite(tau.value) else None, interval, tau.count)
    share = 100 * float(refused.sum()) / max(int(value.notna().sum()), 1)
    return (f"`{one.column}`", one.suite, step.replace("p", "."), share, *cells)


REFUSALS_CASE = Case(
    name="refusals",
    what="order of values that noise has refused, had they been given",
    run=refusals,
    smallest={"suites": ("relief",), "disparity_px": (0.1, 0.6), "preset": "imp"},
    slow=True,
)
