"""Each claim's chart: measured against true, every point a link to its rock."""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup

from validation.execution.run import Run
from validation.report.charts import Points, scatter
from validation.report.format import number
from validation.report.rank_error import farthest
from validation.report.rock_key import RockKey, keys_of
from validation.scores.expectations import TRUTH, Claim
from validation.scores.score import Key, Score
from validation.scores.scoring import claims_of
from validation.scores.titles import title_of, title_of_claim, unit_of
from validation.suite.experiment import Experiment

TRUTH_TITLES = {
    "truth_angularity": "true angularity, 1 − roundness",
    "truth_roundness": "true roundness",
    "truth_roughness": "RMS of the relief over the size",
    "truth_maximum_projection_sphericity": "true maximum projection sphericity",
    "truth_axis_ratio": "true axis ratio",
    "truth_rectangle_ratio": "true short over long side",
}
FEW = 30  # points worth a look on a chart that has too many


@dataclass(frozen=True)
class Plot:
    """A chart with its title and the score that holds its order."""

    title: str
    chart: Markup
    tau: Score
    points: int
    drawn: int

    @property
    def shaded(self) -> bool:
        """Whether only some of the points are marked."""
        return self.drawn < self.points


def tau_name(claim: Claim) -> str:
    """Name of the score that holds a claim's order."""
    return Key(claim.experiment, claim.method, claim.series, claim.measure, "tau").name


def plots(
    run: Run,
    experiment: Experiment,
    shown: Collection[RockKey],
    *,
    most_points: int,
    what: str = "rock",
) -> tuple[Plot, ...]:
    """Chart for each claim; with more points than `most_points`, the farthest alone."""
    scores = {score.name: score for score in run.scores}
    return tuple(
        _plot(run, claim, shown, scores[tau_name(claim)], most_points=most_points, what=what)
        for claim in claims_of(run.suite, experiment)
    )


def _words(truth: str) -> str:
    return truth.removeprefix(TRUTH).replace("_", " ")


def _plot(
    run: Run,
    claim: Claim,
    shown: Collection[RockKey],
    tau: Score,
    *,
    most_points: int,
    what: str,
) -> Plot:
    records = run.records
    own = records["experiment"].eq(claim.experiment) & records["method"].eq(claim.method)
    own &= records["series"].eq(claim.series) & records["eligible"].astype(bool)
    held = records[own]
    x = held[claim.truth].to_numpy(dtype=np.float64)
    y = held[claim.measure].to_numpy(dtype=np.float64)
    drawn = np.arange(len(held))
    if len(held) > most_points:
        worth = held.index.isin(farthest(records, claim, min(FEW, most_points)))
        worth[: most_points // 2] |= (held["scene"] == 0).to_numpy()[: most_points // 2]
        drawn = np.flatnonzero(worth)
    picked = held.iloc[drawn]
    unit, title = unit_of(claim.measure), title_of_claim(claim)
    truth_title = TRUTH_TITLES.get(claim.truth, "true " + _words(claim.truth))
    labels = tuple(
        f"seed {seed}, view {view + 1}, {what} {instance + 1}: {number(value)}"
        for seed, view, instance, value in zip(
            *(picked[name].tolist() for name in ("seed", "view", "instance")),
            y[drawn],
            strict=True,
        )
    )
    chart = scatter(
        Points(
            x,
            y,
            drawn,
            view=tuple(int(view) for view in picked["view"].tolist()),
            label=labels,
            place=tuple(key.id if key in shown else None for key in keys_of(picked)),
        ),
        x_title=truth_title,
        y_title=f"{title}, {unit}" if unit else title,
        summary=f"{title} against {truth_title}, one point a rock and view",
        unshown=f"rule-{claim.experiment}",
    )
    name = f"{title_of(claim.measure)}, {claim.method}"
    return Plot(
        f"{name}; series {claim.series}" if claim.series else name,
        chart,
        tau,
        points=len(held),
        drawn=len(drawn),
    )
