"""Verdict of a measurement in sentences that need no key."""

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rockshape.errors import InputError
from rockshape.measurement import Measurement
from rockshape.measures import Measure, Reason
from rockshape.samples.percentiles import percentiles
from rockshape.samples.sample import sample_of
from rockshape.samples.size_column import size_column

if TYPE_CHECKING:
    import pandas as pd

MANY = 20  # rocks from which percentiles are told
OUTLINE, SOLID = "Outline", "3-D"
_WHY = {
    Reason.TOO_SMALL: "too small in pixels",
    Reason.TRUNCATED: "cut by the frame",
    Reason.CONTACTS: "outlined by neighbours",
    Reason.NO_RANGE: "without range",
}


@dataclass(frozen=True)
class Tally:
    """Counts of what was measured in one image or several, by kinds of measures."""

    images: int
    ranged: int  # images with range
    rocks: int
    whole: dict[str, int]  # rocks that have all measures of a kind
    lacking: dict[str, dict[str, int]]  # rocks that lack some, by the reason in words


def tally_of(measurement: Measurement) -> Tally:
    """Tally of one image."""
    whole, lacking = {}, {}
    for kind, needs_range in ((OUTLINE, False), (SOLID, True)):
        measures = [each for each in measurement.measures if each.needs_range is needs_range]
        if measures:
            whole[kind], lacking[kind] = _completeness(measures, measurement)
    ranged = int(measurement.observation.points_m is not None)
    return Tally(1, ranged, len(measurement), whole, lacking)


def joined(tallies: Iterable[Tally]) -> Tally:
    """Tally of all images of several."""
    images = ranged = rocks = 0
    whole: Counter[str] = Counter()
    lacking: dict[str, Counter[str]] = {}
    for each in tallies:
        images, ranged, rocks = images + each.images, ranged + each.ranged, rocks + each.rocks
        for kind, count in each.whole.items():
            whole[kind] += count
            lacking.setdefault(kind, Counter()).update(each.lacking[kind])
    return Tally(
        images, ranged, rocks, dict(whole), {kind: dict(why) for kind, why in lacking.items()}
    )


def verdict(tally: Tally, frame: "pd.DataFrame") -> list[str]:
    """Sentences: how many rocks, how large, what could be measured, and what could not and why.

    frame is the table, or its columns of sizes and `truncated`.
    """
    count = tally.rocks
    where = "" if tally.images == 1 else f" in {tally.images} images"
    if not count:
        return [f"No rock was measured{where}."]
    told = [f"{count} rock{'s' if count > 1 else ''} measured{where}.", *_sizes(frame)]
    return [*told, *(_measured(kind, tally) for kind in tally.whole)]


def _sizes(frame: "pd.DataFrame") -> list[str]:
    try:
        column = size_column(frame, None)
    except InputError:
        return []
    sample = sample_of(frame, column)
    if not len(sample):
        return []
    of = "intermediate" if column.name.startswith("axis_b") else "minor"
    whole = f"the {len(sample)} that are whole in the frame"
    if len(sample) < MANY:
        low, high = sample.sizes.min(), sample.sizes.max()
        return [f"The {of} axes of {whole} are {low:.3g} to {high:.3g} {column.unit} long."]
    even = np.ones(len(sample))
    low, middle, high = percentiles(sample.sizes, even, (5.0, 50.0, 95.0))
    return [
        f"Nine in ten of {whole} have {of} axes from {low:.3g} to {high:.3g} {column.unit}; "
        f"half are below {middle:.3g} {column.unit}."
    ]


def _completeness(
    measures: Sequence[Measure], measurement: Measurement
) -> tuple[int, dict[str, int]]:
    """Number of rocks that have all measures, and why others lack some."""
    lacking: Counter[str] = Counter()
    whole = 0
    for rock in measurement:
        reasons = {rock.readings[measure.column].reason for measure in measures} - {None}
        whole += not reasons
        for reason in reasons:
            lacking[_WHY.get(reason, str(reason)) if reason is not None else ""] += 1
    return whole, dict(lacking)


def _measured(kind: str, tally: Tally) -> str:
    if kind == SOLID and not tally.ranged:
        return "3-D measures need range, and none was given."
    if tally.whole[kind] == tally.rocks:
        return f"{kind} measures of each."
    why = ", ".join(f"{count} {words}" for words, count in sorted(tally.lacking[kind].items()))
    named, whole = kind[0].lower() + kind[1:], tally.whole[kind]
    return f"All {named} measures of {whole}; others lack some ({why})."
