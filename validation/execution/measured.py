"""Measured view: every method and every measure from elsewhere on it, matched with its truth."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from rockshape.measurement import to_frame
from rockshape.observation import Observation
from rockshape.pipeline import measure
from validation.execution.units import UnitResult
from validation.peers import MeasureSpec, Seen, outlines_px, run_measure
from validation.records.join import RecordKey, join
from validation.records.rock_thumbnails import portraits, whole_view


@dataclass(frozen=True, eq=False)
class ViewCase:
    """One view with its truth, ready to be measured by every method."""

    place: RecordKey  # with the method yet to be named
    observation: Observation
    given: NDArray[np.int32] | None  # labels (rows, cols), or None where rocks are to be found
    instances: NDArray[np.int32]
    truth: pd.DataFrame
    min_iou: float


def measure_view(
    view: ViewCase,
    *,
    methods: Sequence[str],
    measures: Sequence[MeasureSpec],
    pictured: bool,
    portrayed: bool,
) -> UnitResult:
    """Measure a view by the methods, then by measures from elsewhere on the first one's labels.

    `pictured` keeps the whole view, `portrayed` a picture of each rock.
    """
    image = view.observation.image
    found = [measure(view.observation, method=method, labels=view.given) for method in methods]
    labels, rocks = found[0].labels, found[0].instances
    tables = [(each.method, each.labels, to_frame(each)) for each in found]
    seen = Seen(image, labels, view.observation.points_m, outlines_px(rocks))
    tables += [(spec.name, labels, run_measure(spec, seen)) for spec in measures]
    records = pd.concat(
        [
            join(
                replace(view.place, method=method),
                view.truth,
                view.instances,
                own_labels,
                table,
                min_iou=view.min_iou,
            )
            for method, own_labels, table in tables
        ],
        ignore_index=True,
    )
    return UnitResult(
        records,
        pictures=(whole_view(image, found[0], view.place),) if pictured else (),
        backend="",
        portraits=portraits(image, found, view.instances, records, view.place) if portrayed else (),
    )


def joined(views: Sequence[UnitResult], *, backend: str = "") -> UnitResult:
    """Results of a unit's views as the unit's."""
    return UnitResult(
        records=pd.concat([view.records for view in views], ignore_index=True),
        pictures=tuple(picture for view in views for picture in view.pictures),
        backend=backend,
        portraits=tuple(portrait for view in views for portrait in view.portraits),
    )
