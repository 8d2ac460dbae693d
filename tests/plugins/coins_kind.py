"""A kind of experiment in one file: coins of known diameter, measured with a ruler."""

import pandas as pd
from markupsafe import Markup

from validation.execution.units import UnitResult
from validation.scores.judge import Feeds
from validation.scores.score import Definition, Estimate, Key
from validation.suite.experiment import Experiment
from validation.suite.kind import Kind
from validation.suite.registry import register_kind

DIAMETERS_MM = (16.25, 18.75, 21.25, 25.75)


class CoinsExperiment(Experiment, frozen=True, kw_only=True, tag="coins"):
    """Table of a suite: its keys beside name, title and seed, and its units."""

    throws: int
    ruler: float = 1.0  # length that the ruler gives 1

    @property
    def units(self):
        return tuple(("", throw) for throw in range(self.throws))

    def dependencies(self, series, scene):
        return self.plain(without=("title", "throws"))


KIND = register_kind(
    Kind(name="coins", spec=CoinsExperiment, work=__name__, judge=__name__, page=__name__)
)


# work: one unit, done by a worker


def run(unit):
    coins = unit.experiment
    place = {"experiment": coins.name, "kind": "coins", "series": "", "scene": unit.scene}
    place |= {"seed": coins.seed + unit.scene, "view": 0, "method": "ruler"}
    rows = [
        place
        | {"instance": i, "rock": i + 1, "status": "matched", "iou": 1.0, "eligible": True}
        | {"diameter_mm": coins.ruler * d + 0.01 * unit.scene, "truth_diameter_mm": d}
        for i, d in enumerate(DIAMETERS_MM)
    ]
    return UnitResult(pd.DataFrame(rows), pictures=(), backend="")


# judge: what the records amount to


def claims(experiment, measures):
    return ()


view_claims = ranked_claims = claims


def definitions(experiment, measures):
    def error(records):
        own = records[records["experiment"] == experiment.name]
        off = (own["diameter_mm"] - own["truth_diameter_mm"]).abs()
        return Estimate(float(off.max(skipna=False)), len(own))

    key = Key(experiment.name, "ruler", "", "diameter_mm", "error")
    return (Definition(key, "ruler: greatest error", "mm", "coins", "lower", error),)


def lost(records):
    return records.assign(diameter_mm=float("nan"))


FEEDS = Feeds(
    oracle=lambda records, claims: records.assign(diameter_mm=records["truth_diameter_mm"]),
    shuffled=lambda records, rng: lost(records),
    mixed=lambda records, claims, rng: lost(records),
)


# page: its section


def scenes_shown(experiment):
    return None


def section(run, experiment, room):
    return Markup(f'<section id="at-{experiment.name}"><h2>{experiment.title}</h2></section>')
