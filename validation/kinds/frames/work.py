"""One frame of a frames experiment: read, and measured on the outlines drawn by hand."""

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.execution.measured import ViewCase, measure_view
from validation.execution.units import Unit, UnitResult
from validation.kinds.frames.shipped import FRAMES, ShippedFrame, read_frame
from validation.kinds.frames.spec import FramesExperiment
from validation.kinds.frames.statements import STATEMENTS, places
from validation.records.join import RecordKey

PLACE = "truth_place_"  # begins the place that the paper gives a rock by a measure


def views(unit: Unit[FramesExperiment]) -> tuple[list[ViewCase], str]:
    """The unit's frame; no renderer draws it."""
    experiment = unit.experiment
    frame = FRAMES[experiment.frames[unit.scene]]
    observation, labels = read_frame(frame.name)
    case = ViewCase(
        place=RecordKey(experiment.name, "frames", "", unit.scene, experiment.seed, 0, ""),
        observation=observation,
        given=labels,
        instances=labels,
        truth=_truth(frame, np.unique(labels[labels > 0])),
        min_iou=0.5,
    )
    return [case], ""


def _truth(frame: ShippedFrame, numbers: NDArray[np.int32]) -> pd.DataFrame:
    """Row for each outline: a rock that the paper names counts, and has its places."""
    names = {number: name for name, number in frame.rocks.items()}
    table = pd.DataFrame({"instance": numbers - 1})
    named = [names.get(number, "") for number in numbers.tolist()]
    table["eligible"] = [bool(name) for name in named]
    for measure in dict.fromkeys(statement.measure for statement in STATEMENTS):
        said = places(frame.figure, measure)
        table[PLACE + measure] = [said.get(name, np.nan) for name in named]
    return table


def run(unit: Unit[FramesExperiment]) -> UnitResult:
    """Read a frame and measure its rocks."""
    (case,), _ = views(unit)
    return measure_view(
        case,
        methods=unit.experiment.methods,
        measures=unit.measures,
        pictured=False,
        portrayed=False,
    )
