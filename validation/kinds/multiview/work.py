"""One scene of a multi-view experiment: made, and measured in every view."""

import msgspec

from validation.execution.measured import ViewCase, joined, measure_view
from validation.execution.units import Unit, UnitResult
from validation.execution.views import dataset_views, with_eligibility
from validation.kinds.multiview.spec import MultiviewExperiment
from validation.records.join import RecordKey


def views(unit: Unit[MultiviewExperiment]) -> tuple[list[ViewCase], str]:
    """Views of a unit's scene and the renderer."""
    experiment = unit.experiment
    spec = msgspec.structs.replace(
        experiment.scene_at(unit.series), seed=experiment.seed + unit.scene
    )
    kind = str(type(experiment).__struct_config__.tag)
    made, backend = dataset_views(spec)
    return [
        ViewCase(
            place=RecordKey(
                experiment.name, kind, unit.series, unit.scene, spec.seed, view.number, ""
            ),
            observation=view.observation(view.points_m),
            given=view.instances if experiment.labels == "true" else None,
            instances=view.instances,
            truth=with_eligibility(
                view.truth, min_visible_fraction=experiment.min_visible_fraction
            ),
            min_iou=experiment.min_iou,
        )
        for view in made
    ], backend


def run(unit: Unit[MultiviewExperiment]) -> UnitResult:
    """Make a scene, measure its views and match what was found with the truth."""
    experiment = unit.experiment
    cases, backend = views(unit)
    measured = [
        measure_view(
            case,
            methods=experiment.methods,
            measures=unit.measures,
            pictured=experiment.is_pictured(unit.scene),
            portrayed=experiment.has_portraits,
        )
        for case in cases
    ]
    return joined(measured, backend=backend)
