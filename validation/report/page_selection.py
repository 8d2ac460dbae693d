"""Selection of the rocks that the page shows: all where they are few, else the outliers."""

from collections.abc import Iterator
from functools import cache
from itertools import chain, zip_longest

import pandas as pd

from rockshape.method import methods
from validation.execution.run import Run
from validation.records.pictures import Portrait
from validation.report.rank_error import farthest
from validation.report.rock_key import RockKey, keys_of
from validation.report.section import page_of
from validation.scores.scoring import all_claims

FARTHEST = 24  # of each claim, and of what was missed or taken for a rock
_ROCK_BYTES, _VALUE_BYTES = 900, 110  # of a view's row and panel, and of each value there
_MARK_BYTES = 7  # of a point of an outline


def _scenes_shown(run: Run) -> dict[str, int]:
    """Return, for each experiment that shows its rocks one by one, how many scenes come first."""
    shown = {e.name: page_of(e).scenes_shown(e) for e in run.suite.experiments}
    return {name: scenes for name, scenes in shown.items() if scenes is not None}


def _measured(run: Run) -> pd.DataFrame:
    """Records of rocks and shapes that can be shown.

    What is no true rock counts once: measures from elsewhere stand on the first method's masks.
    """
    records = run.records
    again = records["status"].eq("extra") & ~records["method"].isin(list(methods()))
    return records[~again & records["experiment"].isin(list(_scenes_shown(run)))]


def outliers(run: Run) -> list[RockKey]:
    """What is wrong first: missed and taken for rocks, then the farthest of each claim."""
    measured = _measured(run)
    missed = measured[measured["status"].eq("missed") & measured["eligible"].astype(bool)]
    lists = [
        keys_of(missed.head(FARTHEST)),
        keys_of(measured[measured["status"].eq("extra")].head(FARTHEST)),
    ]
    lists += [
        keys_of(run.records.loc[farthest(measured, claim, FARTHEST)])
        for claim in all_claims(run.suite)
    ]
    turns = chain.from_iterable(zip_longest(*lists))
    return list(dict.fromkeys(key for key in turns if key is not None))


def _candidates(run: Run) -> Iterator[RockKey]:
    """Rocks of the pictured scenes, then what is farthest off, then all others."""
    measured = _measured(run)
    if measured.empty:
        return
    shown = measured["scene"] < measured["experiment"].map(_scenes_shown(run))
    yield from keys_of(measured[shown])
    yield from outliers(run)
    for start in range(0, len(measured), 1000):
        yield from keys_of(measured.iloc[start : start + 1000])


def choose(run: Run, budget_bytes: float) -> dict[RockKey, tuple[Portrait, ...]]:
    """Rocks to show with their portraits, as many as the budget allows."""

    @cache
    def album(experiment: str, series: str, scene: int) -> dict[RockKey, list[Portrait]]:
        found: dict[RockKey, list[Portrait]] = {}
        held = run.albums.get((experiment, series, scene), tuple)()
        for one in held:
            place = one.picture.place
            key = RockKey(experiment, series, scene, one.instance)
            if one.instance is None:
                key = key._replace(view=place.view, method=place.method, rock=one.rock or 0)
            found.setdefault(key, []).append(one)
        return found

    chosen: dict[RockKey, tuple[Portrait, ...]] = {}
    columns = sum(len(method.measures) for method in methods().values()) + 4 * len(
        run.suite.measures
    )
    for key in _candidates(run):
        if key in chosen:
            continue
        portraits = tuple(album(*key[:3]).get(key, ()))
        budget_bytes -= _cost(portraits, columns)
        if budget_bytes < 0:
            break
        chosen[key] = portraits
    return chosen


def _cost(portraits: tuple[Portrait, ...], columns: int) -> float:
    """About how many bytes of the page a rock takes."""
    text = max(1, len(portraits)) * (_ROCK_BYTES + _VALUE_BYTES * columns)
    pictures = sum(one.picture.size_bytes for one in portraits) * 4 / 3
    marks = sum(len(mark.outline) / 2 for one in portraits for mark in one.picture.marks)
    return text + pictures + _MARK_BYTES * marks
