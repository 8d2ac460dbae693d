"""Targets of the robust measures beside what the suites score, in one table."""

from dataclasses import dataclass

import numpy as np
import pandas as pd
from case import Case, Cell, Column, Table
from limit_scores import Scored
from suites import suite_scores


@dataclass(frozen=True)
class Target:
    """A score of a suite and the bound that it is to keep."""

    suite: str
    words: str
    score: str
    bound: float
    above: bool = False  # whether the score is to be at least the bound, else at most

    @property
    def goal(self) -> str:
        """The bound as tables have it."""
        return f"{'≥' if self.above else '≤'} {self.bound:g}"

    def met_by(self, value: float) -> bool:
        """Whether a value keeps the bound."""
        return value >= self.bound if self.above else abs(value) <= self.bound


def _least(suite: str, words: str, score: str, bound: float) -> Target:
    return Target(suite, words, score, bound, above=True)


def _pebbles(words: str, name: str) -> tuple[Target, ...]:
    head = f"{name}.robust.third.roundness"
    return (
        Target("outlines", f"{words}: change of the median", f"{head}.change", 0.04),
        _least("outlines", f"{words}: order kept, τ", f"{head}.tau", 0.85),
        _least("outlines", f"{words}: share answered", f"{head}.answered", 0.9),
    )


def _scans(height_deg: int) -> tuple[Target, ...]:
    words = f"sphericity_3d of scanned rocks seen from {height_deg}°, exact range"
    head = f"exact.robust.{height_deg}.sphericity_3d"
    return (
        Target("scans", f"{words}: RMS error", f"{head}.error", 0.05),
        _least("scans", f"{words}: order, τ", f"{head}.tau", 0.6),
    )


TARGETS = (
    *(
        Target(
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
    Target("relief", "roughness_3d over four views: CV", "relief.robust.0.roughness_3d.cv", 0.12),
    *(
        _least(
            "relief",
            f"angularity_3d of edges at {words} m, exact range: order, τ",
            f"distances.robust.{step}.angularity_3d.tau",
            0.6,
        )
        for words, step in (("3", "3"), ("4.5", "4p5"), ("7", "7"))
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
    Target("yard", "angularity_2d over views: CV", "yard.robust.angularity_2d.cv", 0.08),
    _least(
        "yard",
        "angularity_2d over views: pairs in order",
        "yard.robust.angularity_2d.pairs_across",
        0.96,
    ),
    Target(
        "yard",
        "sphericity_3d of made rocks, exact range: RMS error",
        "form.robust.sphericity_3d.error",
        0.03,
    ),
    _least(
        "yard",
        "sphericity_3d of made rocks, exact range: order, τ",
        "form.robust.sphericity_3d.tau",
        0.86,
    ),
    *(target for height_deg in (15, 32, 55) for target in _scans(height_deg)),
    Target(
        "fused",
        "sphericity_3d from four views, exact range, poses refined: RMS error",
        "exact.robust.refined.sphericity_3d.error",
        0.03,
    ),
    Target(
        "fused",
        "sphericity_3d from four views by stereo, poses refined: RMS error",
        "stereo.robust.refined.sphericity_3d.error",
        0.03,
    ),
)
SUITES = tuple(dict.fromkeys(target.suite for target in TARGETS))


def targets(*, suites: tuple[str, ...] = SUITES, preset: str = "", jobs: int = 2) -> list[Table]:
    """Run the suites and table each target with its score and interval."""
    rows: list[tuple[Cell, ...]] = []
    for suite in suites:
        scores = suite_scores(suite, preset=preset, jobs=jobs).set_index("name")
        rows += [_row(target, scores) for target in TARGETS if target.suite == suite]
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


def _row(target: Target, scores: pd.DataFrame) -> tuple[Cell, ...]:
    score = Scored.of(scores.loc[target.score])
    head = (target.words, target.suite, target.goal)
    if np.isnan(score.value):
        return (*head, None, "–", score.count, "no")
    return (*head, *score.cells(), "yes" if target.met_by(score.value) else "no")


TARGETS_CASE = Case(
    name="targets",
    what="targets of the robust measures beside what suites score on seeds held out",
    run=targets,
    smallest={"suites": ("yard",), "preset": "imp", "jobs": 1},
    threads=2,
    slow=True,
)
