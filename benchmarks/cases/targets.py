"""Targets of the robust measures beside what the suites score, in one table."""

from dataclasses import dataclass

import numpy as np
from case import Case, Cell, Column, Table
from chart_scores import CHART_SIZES_PX, chart_scores
from limit_scores import Scored
from suites import suite_scores

CHART = "–"  # in place of a suite: outlines drawn for this table


@dataclass(frozen=True)
class Target:
    """A score of a suite, or of drawn outlines, and the bounds that it is to keep."""

    suite: str
    words: str
    score: str
    least: float = -np.inf
    most: float = np.inf

    @property
    def goal(self) -> str:
        """The bounds as tables have them."""
        if np.isfinite(self.least) and np.isfinite(self.most):
            return f"{self.least:g} … {self.most:g}"
        return f"≥ {self.least:g}" if np.isfinite(self.least) else f"≤ {self.most:g}"

    def met_by(self, value: float) -> bool:
        """Whether a value keeps the bounds."""
        return self.least <= value <= self.most


def _least(suite: str, words: str, score: str, bound: float) -> Target:
    return Target(suite, words, score, least=bound)


def _most(suite: str, words: str, score: str, bound: float) -> Target:
    return Target(suite, words, score, most=bound)


def _chart(size_px: int) -> tuple[Target, ...]:
    words, head = f"of 81 rough silhouettes, {size_px} px", f"chart.{size_px}"
    return (
        _least(CHART, f"roundness {words}: r", f"{head}.roundness.r", 0.93),
        _most(CHART, f"roundness {words}: mean absolute error", f"{head}.roundness.error", 0.09),
        _least(CHART, f"angularity_2d {words}: r", f"{head}.angularity_2d.r", 0.93),
    )


def _pebbles(words: str, name: str) -> tuple[Target, ...]:
    head = f"{name}.robust.third.roundness"
    return (
        Target("outlines", f"{words}: change of the median", f"{head}.change", -0.04, 0.04),
        _least("outlines", f"{words}: order kept, τ", f"{head}.tau", 0.85),
        _least("outlines", f"{words}: share answered", f"{head}.answered", 0.9),
    )


def _views(suite: str, words: str, head: str, *, truth: str) -> tuple[Target, ...]:
    return (
        _most(
            suite, f"{words}: SD within a rock over SD between", f"{head}.within_over_between", 0.3
        ),
        Target(suite, f"{words}: slope on {truth}", f"{head}.slope", 0.8, 1.2),
    )


def _refused(suite: str, words: str, head: str) -> Target:
    return _most(suite, f"values refused: {words}", f"{head}.refused", 0.02)


def _scans(height_deg: int) -> tuple[Target, ...]:
    rocks = f"scanned rocks seen from {height_deg}°, exact range"
    words = f"sphericity_3d of {rocks}"
    head = f"exact.robust.{height_deg}"
    return (
        _most(
            "scans", f"{words}: mean absolute error", f"{head}.sphericity_3d.absolute_error", 0.05
        ),
        _least("scans", f"{words}: order, τ", f"{head}.sphericity_3d.tau", 0.6),
        _most(
            "scans",
            f"half-axes of {rocks}: mean absolute relative error",
            f"{head}.axes_error",
            0.07,
        ),
    )


TARGETS = (
    *(target for size_px in CHART_SIZES_PX for target in _chart(size_px)),
    _least(
        CHART, "roundness of rocks of eleven corners, 100 px: r", "corners.100.roundness.r", 0.85
    ),
    Target(
        CHART,
        "roundness of rocks of eleven corners, 100 px: bias",
        "corners.100.roundness.bias",
        -0.05,
        0.05,
    ),
    *(
        _most(
            "outlines",
            f"roundness of polygons of known corners, {size} px: RMS error",
            f"at{size}.robust.roundness.roundness.error",
            0.05,
        )
        for size in (60, 100, 200, 500)
    ),
    *_pebbles("roundness of pebbles at a third of their resolution", "pebbles"),
    *_pebbles("roundness of those of a photograph held out", "pebbles-held-out"),
    _least(
        "relief", "roughness_3d, exact range: order, τ", "relief.robust.0.roughness_3d.tau", 0.95
    ),
    _least(
        "relief", "roughness_3d, 0.1 px noise: order, τ", "relief.robust.0p1.roughness_3d.tau", 0.9
    ),
    _least(
        "relief",
        "roughness_3d over four views: pairs in order",
        "relief.robust.0.roughness_3d.pairs_across",
        0.96,
    ),
    _most("relief", "roughness_3d over four views: CV", "relief.robust.0.roughness_3d.cv", 0.12),
    *_views(
        "relief",
        "roughness_3d over four views",
        "relief.robust.0.roughness_3d",
        truth="the relief's RMS",
    ),
    *(
        _least(
            "relief",
            f"angularity_3d of edges at {words} m, exact range: order, τ",
            f"distances.robust.{step}.angularity_3d.tau",
            0.97,
        )
        for words, step in (("3", "3"), ("4.5", "4p5"), ("7", "7"))
    ),
    _least(
        "relief",
        "angularity_3d of edges at 3 to 7 m pooled, exact range: order, τ",
        "distances.robust.angularity_3d.pooled_tau",
        0.85,
    ),
    _least(
        "relief",
        "angularity_3d by a rover's stereo at 4.5 m: share answered",
        "rover.robust.0p11.angularity_3d.answered",
        0.6,
    ),
    _least(
        "relief",
        "angularity_3d by a rover's stereo at 4.5 m: order, τ",
        "rover.robust.0p11.angularity_3d.tau",
        0.6,
    ),
    _most("yard", "angularity_2d over views: CV", "yard.robust.angularity_2d.cv", 0.08),
    *_views(
        "yard",
        "angularity_2d over views",
        "yard.robust.angularity_2d",
        truth="1 - Wadell's roundness",
    ),
    _least(
        "yard",
        "angularity_2d over views: pairs in order",
        "yard.robust.angularity_2d.pairs_across",
        0.96,
    ),
    _most(
        "yard",
        "sphericity_3d of made rocks, exact range: mean absolute error",
        "form.robust.sphericity_3d.absolute_error",
        0.03,
    ),
    _least(
        "yard",
        "sphericity_3d of made rocks, exact range: order, τ",
        "form.robust.sphericity_3d.tau",
        0.86,
    ),
    _most(
        "noise",
        "sphericity_3d of made rocks, 0.32 px noise: mean absolute error",
        "noise.robust.0p32.sphericity_3d.absolute_error",
        0.035,
    ),
    _least(
        "noise",
        "sphericity_3d of made rocks, 0.32 px noise: order, τ",
        "noise.robust.0p32.sphericity_3d.tau",
        0.82,
    ),
    _refused("relief", "rocks of edges at 7 m, exact range", "distances.robust.7"),
    _refused("relief", "rocks by a rover's stereo at 4.5 m", "rover.robust.0p11"),
    _refused("yard", "made rocks from angular to round", "yard.robust"),
    _refused("yard", "made rocks from flat to equal-sided", "form.robust"),
    *(
        _refused(
            "scans",
            f"scanned rocks seen from {height_deg}°, exact range",
            f"exact.robust.{height_deg}",
        )
        for height_deg in (15, 32, 55)
    ),
    *(target for height_deg in (15, 32, 55) for target in _scans(height_deg)),
    _most(
        "fused",
        "sphericity_3d from four views, exact range, poses refined: mean absolute error",
        "exact.robust.refined.sphericity_3d.absolute_error",
        0.03,
    ),
    _most(
        "fused",
        "sphericity_3d from four views by stereo, poses refined: mean absolute error",
        "stereo.robust.refined.sphericity_3d.absolute_error",
        0.03,
    ),
)
SUITES = tuple(dict.fromkeys(target.suite for target in TARGETS))


def targets(
    *,
    suites: tuple[str, ...] = SUITES,
    every: int = 1,
    scenes: int = 14,
    preset: str = "",
    jobs: int = 2,
) -> list[Table]:
    """Run the suites, draw the outlines, and table each target with its score and interval."""
    rows: list[tuple[Cell, ...]] = []
    for suite in suites:
        if suite == CHART:
            found = chart_scores(every=every, scenes=scenes)
        else:
            scores = suite_scores(suite, preset=preset, jobs=jobs).set_index("name")
            found = {target.score: Scored.of(scores.loc[target.score]) for target in _of(suite)}
        rows += [_row(target, found[target.score]) for target in _of(suite)]
    columns = (
        Column("what"),
        Column("suite"),
        Column("target"),
        Column("found", "", ".3f"),
        Column("95 %"),
        Column("values", "", "d"),
        Column("met"),
    )
    return [Table(columns, rows)]


def _of(suite: str) -> list[Target]:
    return [target for target in TARGETS if target.suite == suite]


def _row(target: Target, score: Scored) -> tuple[Cell, ...]:
    head = (target.words, target.suite, target.goal)
    if np.isnan(score.value):
        return (*head, None, "–", score.count, "no")
    return (*head, *score.cells(), "yes" if target.met_by(score.value) else "no")


TARGETS_CASE = Case(
    name="targets",
    what="targets of the robust measures beside what suites score on seeds held out",
    run=targets,
    smallest={"suites": (CHART, "yard"), "every": 9, "scenes": 1, "preset": "imp", "jobs": 1},
    threads=2,
    slow=True,
)
