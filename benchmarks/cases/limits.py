"""Targets beside what an estimator reaches that is told the truth of outline, surface or noise."""

from dataclasses import dataclass

from case import Case, Cell, Column, Table
from cases.targets import TARGETS
from chart_scores import CHART_SIZES_PX, chart_scores, smooth_scores
from limit_scores import Scored
from outline_limits import EXACT, OURS, outline_scores, outline_table
from outline_limits import READINGS as OF_OUTLINES
from outline_limits import STATISTICS as OF_YARD
from pebble_limits import LIKE, PEBBLES, pebble_scores, pebble_table
from pebble_limits import READINGS as OF_PEBBLES
from relief_limits import NOISY_RELIEF, RELIEF, relief_scores, relief_table
from relief_limits import OURS as ROUGHNESS
from relief_limits import STATISTICS as OF_RELIEF
from suites import suite_scores

_NOISE = "noise.robust.{}.sphericity_3d.{}"
_FUSED = "{}.robust.refined.sphericity_3d.absolute_error"
# scores of noisy range, and the same of exact range
OF_NOISE = {_NOISE.format("0p32", "tau"): _NOISE.format("0", "tau")}
OF_FUSED = {_FUSED.format("stereo"): _FUSED.format("exact")}


@dataclass(frozen=True)
class Limit:
    """A target's score of ours beside that of an estimator to which something is told."""

    target: str  # its score
    ours: Scored
    told: str
    limit: Scored

    def row(self) -> tuple[Cell, ...]:
        """Row of the summary."""
        target = next(one for one in TARGETS if one.score == self.target)
        return (target.words, target.goal, *self.ours.cells(), self.told, *self.limit.cells()[:2])


def limits(
    *,
    scenes: int = 12,
    relief_scenes: int = 2,
    draws: int = 20,
    experiments: int = 2,
    sets: int = 20,
    charts: int = 5,
    every: int = 1,
    preset: str = "",
    jobs: int = 1,
) -> list[Table]:
    """Score what is told of outlines, pebbles and reliefs, and set it beside ours."""
    outlines = outline_scores(scenes=scenes, preset=preset)
    pebbles = pebble_scores(experiments=experiments, sets=sets, charts=charts)
    reliefs = relief_scores(scenes=relief_scenes, draws=draws, preset=preset)
    found = [
        Limit(
            f"yard.robust.angularity_2d.{key}",
            outlines[key, OF_OUTLINES[OURS]],
            "each view's exact outline",
            outlines[key, OF_OUTLINES[EXACT]],
        )
        for key in OF_YARD
    ]
    first = OF_PEBBLES[0].words
    found += [
        Limit(
            f"{experiment}.robust.third.roundness.{key}",
            pebbles[experiment, PEBBLES, first, key],
            "no hand: drawn outlines, as wide and as round",
            pebbles[experiment, LIKE, first, key],
        )
        for experiment, kind, words, key in pebbles
        if kind == PEBBLES and words == first
    ]
    found += [
        Limit(
            f"relief.robust.{step}.roughness_3d.{key}",
            reliefs[key, step, ROUGHNESS],
            told,
            reliefs[key, step, limit],
        )
        for key, step, limit, told in (
            *((key, "0", RELIEF, "the smooth form under the surface in view") for key in OF_RELIEF),
            ("tau", "0p1", NOISY_RELIEF, "that, and the noise's power"),
        )
    ]
    found += [
        *_chart(every),
        *_by_range("noise", OF_NOISE, preset, jobs),
        *_by_range("fused", OF_FUSED, preset, jobs),
    ]
    columns = (
        Column("what"),
        Column("target"),
        Column("`robust`", "", ".3f"),
        Column("95 %"),
        Column("values", "", "d"),
        Column("what another is told"),
        Column("what it has", "", ".3f"),
        Column("95 %"),
    )
    summary = Table(columns, [one.row() for one in found], name="summary")
    return [summary, outline_table(outlines), pebble_table(pebbles), relief_table(reliefs)]


def _chart(every: int) -> list[Limit]:
    """Rough silhouettes, beside the same without what makes them rough."""
    ours, smooth = chart_scores(every=every, scenes=1), smooth_scores(every=every)
    names = [(500, "roundness.error"), *((size, "angularity_2d.r") for size in CHART_SIZES_PX)]
    return [
        Limit(
            f"chart.{size_px}.{name}",
            ours[f"chart.{size_px}.{name}"],
            "the exact outline without its waves",
            smooth[name],
        )
        for size_px, name in names
    ]


def _by_range(suite: str, names: dict[str, str], preset: str, jobs: int) -> list[Limit]:
    """Scores of noisy range, beside those of the same rocks from exact range."""
    scores = suite_scores(suite, preset=preset, jobs=jobs).set_index("name")
    return [
        Limit(noisy, Scored.of(scores.loc[noisy]), "exact range", Scored.of(scores.loc[exact]))
        for noisy, exact in names.items()
    ]


LIMITS_CASE = Case(
    name="limits",
    what="targets beside what the true outline, surface or range would tell",
    run=limits,
    smallest={
        "scenes": 1,
        "relief_scenes": 1,
        "draws": 1,
        "experiments": 1,
        "sets": 1,
        "charts": 1,
        "every": 9,
        "preset": "imp",
        "jobs": 1,
    },
    slow=True,
)
