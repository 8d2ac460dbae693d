"""One picture of a pebbles experiment: its masks, measured at each resolution."""

import numpy as np
import pandas as pd

from rockshape.method import find_method
from rockshape.observation import Observation
from validation.execution.measured import ViewCase, measure_view
from validation.execution.units import Unit, UnitResult
from validation.kinds.pebbles.sheet import pebble_masks, sheet, shrunk
from validation.kinds.pebbles.spec import FACTORS, PebblesExperiment
from validation.records.join import RecordKey

FULL = "full"  # series of the values that stand for the truth
TRUTH = "truth_"  # begins the name of a value at full resolution, as claims ask for truths
_OF_ROCK = ["method", "instance"]


def views(unit: Unit[PebblesExperiment]) -> tuple[list[ViewCase], str]:
    """Sheets of the unit's pebbles, the one of full resolution first; no renderer draws them."""
    experiment = unit.experiment
    labels = experiment.pictures.picture(experiment.seed, unit.scene).truth.labels
    masks = [] if labels is None else pebble_masks(labels, experiment.min_width_px)
    factors = {FULL: 1} | {series: FACTORS[series] for series in experiment.series}
    cases = []
    for series, factor in factors.items():
        drawn = sheet([shrunk(mask, factor) for mask in masks])
        cases.append(
            ViewCase(
                place=RecordKey(
                    experiment.name, "pebbles", series, unit.scene, experiment.seed, 0, ""
                ),
                observation=Observation(image=np.zeros(drawn.shape, np.float32)),
                given=drawn,
                instances=drawn,
                truth=pd.DataFrame({"instance": np.arange(len(masks)), "eligible": True}),
                min_iou=0.5,
            )
        )
    return cases, ""


def run(unit: Unit[PebblesExperiment]) -> UnitResult:
    """Measure a picture's pebbles at each resolution, beside the values of the full one."""
    full, *coarse = (
        measure_view(
            case,
            methods=unit.experiment.methods,
            measures=unit.measures,
            pictured=False,
            portrayed=False,
        ).records
        for case in views(unit)[0]
    )
    own = [m.column for method in unit.experiment.methods for m in find_method(method).measures]
    other = [column for spec in unit.measures for column in spec.expected_trait]
    columns = [name for name in dict.fromkeys(own + other) if name in full]
    truth = full[[*_OF_ROCK, *columns]].rename(columns={name: TRUTH + name for name in columns})
    records = [table.merge(truth, on=_OF_ROCK, how="left") for table in coarse]
    return UnitResult(pd.concat(records, ignore_index=True), (), "")
