"""Order of values that are refused as not resolvable, had they been given."""

from contextlib import ExitStack
from unittest import mock

import msgspec
import numpy as np
import pandas as pd
from case import Case, Cell, Column, Table
from limit_scores import scored
from numpy.typing import NDArray
from suites import chosen_suite

from rockshape.ellipsoid import Ellipsoid
from rockshape.measures import ellipsoid_error, roughness_3d
from rockshape.numerics.robust_scale import biweight_scale
from rockshape.surface import Relief
from validation.execution.units import units_of
from validation.execution.work import run_unit
from validation.scores.blocks import blocks_of
from validation.scores.expectations import TRUTH, Claim

DISPARITY_PX = (0.1, 0.2, 0.32, 0.6)
_ROCK = ["scene", "view", "instance"]
# value that noise can hide and what it tells, by a suite whose experiment of that name varies it
REFUSED = {
    "noise": (ellipsoid_error.ROBUST.column, "angularity"),
    "relief": (roughness_3d.ROBUST.column, "roughness"),
}


def refusals(
    *,
    suites: tuple[str, ...] = tuple(REFUSED),
    disparity_px: tuple[float, ...] = DISPARITY_PX,
    preset: str = "",
) -> list[Table]:
    """Hold values that are refused in noise to the truth, beside those that are given."""
    rows: list[tuple[Cell, ...]] = []
    for suite in suites:
        as_is = _records(suite, disparity_px, preset)
        with ExitStack() as changed:
            for module, name, other in UNGATED:
                changed.enter_context(mock.patch.object(module, name, other))
            ungated = _records(suite, disparity_px, preset)
        rows += [_row(suite, step, as_is[step], ungated[step]) for step in as_is]
    columns = [Column("value"), Column("truth"), Column("σ_d, px"), Column("refused", "%", ".0f")]
    for words in ("given: order, τ", "refused: order, τ"):
        columns += [Column(words, "", ".2f"), Column("95 %"), Column("pairs", "", "d")]
    return [Table(tuple(columns), rows)]


def _signed_error(
    ellipsoid: Ellipsoid, points_m: NDArray[np.float64], *, noise_m: float = 0.0
) -> float:
    """Ellipsoid error below 0 where noise makes more than what is seen."""
    square = biweight_scale(ellipsoid.radial_distance_m(points_m)) ** 2 - noise_m**2
    return _signed_root(square) / float(np.cbrt(ellipsoid.half_axes_m.prod()))


def _signed_roughness(relief: Relief) -> float:
    """Roughness below 0 where noise makes more than what is seen."""
    return _signed_root(relief.rough**2 - relief.noise_rough**2)


def _signed_root(square: float) -> float:
    return float(np.sign(square) * np.sqrt(abs(square)))


UNGATED = (
    (ellipsoid_error, "MAX_NOISE", np.inf),
    (ellipsoid_error, "ellipsoid_error", _signed_error),
    (roughness_3d, "MAX_NOISE_SHARE", np.inf),
    (roughness_3d, "roughness_3d", _signed_roughness),
)


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


def _row(suite: str, step: str, as_is: pd.DataFrame, ungated: pd.DataFrame) -> tuple[Cell, ...]:
    column, truth = REFUSED[suite]
    value = ungated[column].where(ungated["eligible"].astype(bool))
    refused = as_is[column].isna() & value.notna()
    cells: list[Cell] = []
    for kept in (~refused, refused):
        records = ungated.assign(**{column: value.where(kept)}).reset_index()
        blocks = blocks_of(records, Claim(suite, step, "robust", column, TRUTH + truth))
        tau = scored("tau", blocks, name=f"{suite}.robust.{step}.{column}")
        interval = "–" if tau.interval == "–" else f"{tau.low:.2f} … {tau.high:.2f}"
        cells += (tau.value if np.isfinite(tau.value) else None, interval, tau.count)
    there = int(value.notna().sum())
    share = 100 * float(refused.sum()) / there if there else None
    return (f"`{column}`", truth, step.replace("p", "."), share, *cells)


REFUSALS_CASE = Case(
    name="refusals",
    what="order of values that noise has refused, had they been given",
    run=refusals,
    smallest={"suites": ("relief",), "disparity_px": (0.1, 0.6), "preset": "imp"},
    slow=True,
)
