"""One drawing of a shapes experiment: drawn, and measured on its true masks."""

from pathlib import Path
from tempfile import TemporaryDirectory

from rockshape.io import read_image, read_labels
from rockshape.observation import Observation
from synth.shapes import write_series
from validation.execution.measured import ViewCase, measure_view
from validation.execution.units import Unit, UnitResult
from validation.kinds.shapes.spec import ShapesExperiment
from validation.records.join import RecordKey
from validation.records.truth import read_instances, read_shape_truth

MIN_IOU = 0.5


def views(unit: Unit[ShapesExperiment]) -> tuple[list[ViewCase], str]:
    """One view of a unit's drawing; no renderer draws it."""
    experiment = unit.experiment
    seed = experiment.seed + unit.scene
    with TemporaryDirectory(prefix="rockshape-") as parent:
        folder = Path(parent) / "data"
        write_series(
            unit.series,
            folder,
            count=experiment.count,
            seed=seed,
            size_px=experiment.size_px,
            jitter_rms_px=experiment.jitter_px,
        )
        image = read_image(folder / "image.png")
        case = ViewCase(
            place=RecordKey(experiment.name, "shapes", unit.series, unit.scene, seed, 0, ""),
            observation=Observation(image=image),
            given=read_labels(folder / "labels.png", shape=image.shape, pieces="keep").to_labels(),
            instances=read_instances(folder / "labels.png"),
            truth=read_shape_truth(folder / "truth.csv").assign(eligible=True),
            min_iou=MIN_IOU,
        )
    return [case], ""


def run(unit: Unit[ShapesExperiment]) -> UnitResult:
    """Draw a series and measure its shapes."""
    (case,), _ = views(unit)
    return measure_view(
        case,
        methods=unit.experiment.methods,
        measures=unit.measures,
        pictured=unit.experiment.is_pictured(unit.scene),
        portrayed=True,
    )
