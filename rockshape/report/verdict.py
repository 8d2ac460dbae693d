"""Verdict of a measurement in sentences that need no key."""

import numpy as np

from rockshape.errors import InputError
from rockshape.measurement import Measurement
from rockshape.measures import Measure, Reason
from rockshape.samples.percentiles import percentiles
from rockshape.samples.sample import sample_of
from rockshape.samples.size_column import size_column

MANY = 20  # rocks from which percentiles are told
_WHY = {
    Reason.TOO_SMALL: "too small in pixels",
    Reason.TRUNCATED: "cut by the frame",
    Reason.CONTACTS: "outlined by neighbours",
    Reason.NO_RANGE: "without range",
}


def verdict(measurement: Measurement) -> list[str]:
    """Sentences: how many rocks, how large, what could be measured, and what could not and why."""
    count = len(measurement)
    if not count:
        return ["No rock was measured."]
    told = [f"{count} rock{'s' if count > 1 else ''} measured.", *_sizes(measurement)]
    for name, needs_range in (("Outline", False), ("3-D", True)):
        measures = [each for each in measurement.measures if each.needs_range is needs_range]
        if measures:
            told.append(_measured(name, measures, measurement))
    return told


def _sizes(measurement: Measurement) -> list[str]:
    frame = measurement.to_frame()
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


def _measured(name: str, measures: list[Measure], measurement: Measurement) -> str:
    if name == "3-D" and measurement.observation.points_m is None:
        return "3-D measures need range, and none was given."
    columns = [measure.column for measure in measures]
    lacking: dict[str, int] = {}
    whole = 0
    for rock in measurement:
        reasons = {rock.readings[column].reason for column in columns} - {None}
        whole += not reasons
        for reason in reasons:
            words = _WHY.get(reason, str(reason)) if reason is not None else ""
            lacking[words] = lacking.get(words, 0) + 1
    if whole == len(measurement):
        return f"{name} measures of each."
    why = ", ".join(f"{count} {words}" for words, count in sorted(lacking.items()))
    return f"All {name[0].lower() + name[1:]} measures of {whole}; others lack some ({why})."
