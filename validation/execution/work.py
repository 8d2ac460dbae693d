"""The work of a unit: made, measured (or segmented) and matched, a pure function of its spec."""

from dataclasses import replace

import pandas as pd

from rockshape.measurement import to_frame
from rockshape.pipeline import measure
from validation.execution.units import (
    DesignUnit,
    MeasuredUnit,
    SegmentationUnit,
    Unit,
    UnitResult,
    is_pictured,
    is_portrayed,
)
from validation.execution.views import ViewCase, data_folder, views_of
from validation.kinds.design.work import run_design
from validation.kinds.segmentation.work import run_scene
from validation.peers import Seen, run_measure
from validation.records.join import join
from validation.records.rock_thumbnails import portraits, whole_view


def _measure_view(view: ViewCase, unit: MeasuredUnit) -> UnitResult:
    """Measure a view by the methods, then by measures from elsewhere on the first one's labels."""
    image = view.observation.image
    found = [
        measure(view.observation, method=method, labels=view.given)
        for method in unit.experiment.methods
    ]
    labels = found[0].labels
    tables = [(each.method, each.labels, to_frame(each)) for each in found]
    seen = Seen(image, labels, view.observation.points_m)
    tables += [(spec.name, labels, run_measure(spec, seen)) for spec in unit.measures]
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
        pictures=(whole_view(image, found[0], view.place),) if is_pictured(unit) else (),
        backend="",
        portraits=portraits(image, found, view.instances, records, view.place)
        if is_portrayed(unit)
        else (),
    )


def run_unit(unit: Unit) -> UnitResult:
    """Make, measure (or segment) and match one unit."""
    if isinstance(unit, SegmentationUnit):
        with data_folder() as folder:
            return UnitResult(*run_scene(unit.experiment, unit.scene, folder))
    if isinstance(unit, DesignUnit):
        records, backend = run_design(unit.experiment, unit.scene)
        return UnitResult(records=records, pictures=(), backend=backend)
    views, backend = views_of(unit)
    measured = [_measure_view(view, unit) for view in views]
    return UnitResult(
        records=pd.concat([view.records for view in measured], ignore_index=True),
        pictures=tuple(picture for view in measured for picture in view.pictures),
        backend=backend,
        portraits=tuple(portrait for view in measured for portrait in view.portraits),
    )
