"""Studies over whole suites: why values move between views, and what the gates catch."""

from typing import Any

import numpy as np
from case import Case, Column, Table
from suites import chosen_suite, suite_scores

from rockshape.method import methods
from validation.mutations import MUTATIONS, made_views, prepare_bench

CAUSES = {
    "view": "view",
    "distance": "distance",
    "light": "light",
    "noise": "range noise",
    "segmentation": "segmentation",
    "rest": "pixel grid",
}


def movement(*, preset: str = "", jobs: int = 2) -> list[Table]:
    """Run the suite `views` and table each cause's share, and how far orders hold."""
    scores = scores_by_measure(preset=preset, jobs=jobs)
    shares, clean, orders = [], [], []
    for method in ("paper", "robust"):
        for column in (measure.column for measure in methods()[method].measures):
            own = scores[method, column]
            percent = {name: _cell(score, 100.0, 0) for name, score in own.items()}
            head = (method, f"`{column}`")
            shares.append(
                (
                    *head,
                    *(percent[name] for name in ("cv_clean", "cv")),
                    *(percent[f"share_{cause}"] for cause in CAUSES),
                    percent.get("true_share", "–"),
                    own["cv"].count,
                )
            )
            parts = [own[f"share_{cause}"].value for cause in ("view", "distance", "rest")]
            if np.isfinite(sum(parts)):
                clean.append((*head, *(100 * part / sum(parts) for part in parts)))
            orders.append(
                (
                    *head,
                    *(percent[f"measured_{state}"] for state in ("clean", "found", "noisy")),
                    *(percent[name] for name in ("shared_clean", "shared")),
                    *(_cell(own[name], 1.0, 2) for name in ("tau_frames_clean", "tau_frames")),
                    *(percent[name] for name in ("order_within", "order_across")),
                )
            )
    head = (Column("method"), Column("measure"))
    share_heads = ("CV clean", "CV", *CAUSES.values(), "true share of view")
    order_heads = ("clean", "found", "noisy", "shared, clean", "shared, noisy")
    order_heads += ("τ_b of two frames, clean", "noisy", "one frame", "two frames")
    return [
        Table(
            (*head, *(Column(h, "%") for h in share_heads), Column("rocks", "", "d")),
            shares,
            name="shares",
        ),
        Table(
            (*head, *(Column(h, "%", ".0f") for h in ("view", "distance", "pixel grid"))),
            clean,
            name="clean",
        ),
        Table((*head, *map(Column, order_heads)), orders, name="orders"),
    ]


def scores_by_measure(*, preset: str = "", jobs: int) -> dict[tuple[str, str], dict[str, Any]]:
    """Return the scores of suite `views` by method and measure, then by statistic."""
    found: dict[tuple[str, str], dict[str, Any]] = {}
    for score in suite_scores("views", preset=preset, jobs=jobs).itertuples():
        found.setdefault((score.method, score.measure), {})[score.statistic] = score
    return found


def _cell(score: Any, factor: float, digits: int) -> str:
    """Return a score with its interval."""
    if not np.isfinite(score.value):
        return "–"
    value, low, high = (f"{factor * v:.{digits}f}" for v in (score.value, score.low, score.high))
    return f"{value} ({low}…{high})"


def mutations(*, preset: str = "", scenes: int = 2, count: int = 99) -> list[Table]:
    """Put errors in on purpose and name the gates of the suite `ci` that fail under each."""
    suite, tables = chosen_suite("ci", preset=preset), []
    views = made_views(suite, scenes=scenes)
    for method in ("paper", "robust"):
        bench = prepare_bench(suite, scenes=scenes, method=method, views=views)
        control = bench.failing(bench.records)
        bitten: set[str] = set()
        rows = []
        for mutation in MUTATIONS[method][-count:]:
            gates = [gate for gate in bench.catch(mutation).gates if gate not in control]
            bitten |= set(gates)
            caught = ", ".join(f"`{gate}`" for gate in gates) or "**none**"
            rows.append((mutation.name, mutation.what, caught))
        every = {f"{g.score} {g.relation} {g.bound:g}" for g in bench.suite.gates}
        idle = sorted(every - bitten - set(control))
        told = ", ".join(f"`{gate}`" for gate in idle) or "none"
        rows.append(("gates that caught none", "", told))
        heads = ("mutation", "what is wrong", "gates that caught it")
        tables.append(Table([Column(head) for head in heads], rows, name=method))
    return tables


FINDINGS_CASE = Case(
    name="findings",
    what="shares of each cause in the movement of one rock's values, suite `views`",
    run=movement,
    smallest={"preset": "imp", "jobs": 1},
    slow=True,
)

MUTATIONS_CASE = Case(
    name="mutations",
    what="errors put in on purpose, and the gates of suite `ci` that catch them",
    run=mutations,
    smallest={"preset": "imp", "scenes": 1, "count": 1},
    slow=True,
)
