"""Work units: one scene or one drawing made, measured and matched, a pure function of its spec."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import msgspec
import numpy as np
import pandas as pd
import scipy.ndimage as ndi
from numpy.typing import NDArray

from rockshape.io import read_camera, read_image, read_labels, read_range
from rockshape.observation import Observation
from rockshape.pipeline import measure
from rockshape.table import to_frame
from synth.dataset import write_common, write_scene
from synth.render import choose_backend
from synth.shapes import write_series
from validation.design.unit import run_design
from validation.measures import MeasureSpec, Seen, run_measure, source_digest
from validation.pictures import Picture, Portrait
from validation.portraits import portraits, whole_view
from validation.records import Place, join
from validation.segments.unit import run_scene
from validation.suite import (
    DesignExperiment,
    SegmentationExperiment,
    ShapesExperiment,
    Suite,
    YardExperiment,
)
from validation.truth import (
    SceneTruth,
    read_instances,
    read_scene_truth,
    read_shape_truth,
    rock_columns,
    view_columns,
)


@dataclass(frozen=True)
class SceneUnit:
    """Scene number `scene` of an experiment of rocks, at one step of its sweep."""

    experiment: YardExperiment
    series: str
    scene: int
    measures: tuple[MeasureSpec, ...] = ()  # beside the experiment's methods


@dataclass(frozen=True)
class DrawingUnit:
    """Drawing number `scene` of one series of an experiment of shapes."""

    experiment: ShapesExperiment
    series: str
    scene: int
    measures: tuple[MeasureSpec, ...] = ()


@dataclass(frozen=True)
class SegmentationUnit:
    """Scene number `scene` of an experiment of segmentation."""

    experiment: SegmentationExperiment
    scene: int


@dataclass(frozen=True)
class DesignUnit:
    """Scene number `scene` of a designed experiment, in all its cells."""

    experiment: DesignExperiment
    scene: int


MeasuredUnit = SceneUnit | DrawingUnit
Unit = MeasuredUnit | SegmentationUnit | DesignUnit


@dataclass(frozen=True, eq=False)
class UnitResult:
    """What became of a unit."""

    records: pd.DataFrame  # one row a view, method (or way) and rock: true, found or both
    pictures: tuple[Picture, ...]
    backend: str  # the renderer, empty for drawings
    portraits: tuple[Portrait, ...] = ()

    def album(self) -> tuple[Portrait, ...]:
        """Return the portraits."""
        return self.portraits


def units_of(suite: Suite) -> tuple[Unit, ...]:
    """Return all units of a suite, in the order of their records."""
    units: list[Unit] = []
    for experiment in suite.experiments:
        if isinstance(experiment, YardExperiment):
            units += [
                SceneUnit(experiment, step, scene, suite.measures)
                for step in experiment.series
                for scene in range(experiment.scenes)
            ]
        elif isinstance(experiment, SegmentationExperiment):
            units += [SegmentationUnit(experiment, scene) for scene in range(experiment.scenes)]
        elif isinstance(experiment, DesignExperiment):
            units += [DesignUnit(experiment, scene) for scene in range(experiment.scenes)]
        else:
            units += [
                DrawingUnit(experiment, series, drawing, suite.measures)
                for series in experiment.series
                for drawing in range(experiment.drawings)
            ]
    return tuple(units)


def describe(unit: Unit) -> str:
    """Return a unit's name for the progress."""
    series = unit.series if isinstance(unit, MeasuredUnit) else ""
    words = (unit.experiment.name, series, str(unit.experiment.seed + unit.scene))
    return " ".join(word for word in words if word)


def spec_of(unit: Unit) -> dict[str, object]:
    """Return all that a unit's result depends on but the code, as plain values.

    How many scenes there are, what they vary and what they are called is of no account.
    """
    spec: dict[str, object] = msgspec.to_builtins(unit.experiment)
    for name in ("title", "scenes", "drawings", "varied", "pictured"):
        spec.pop(name, None)
    spec |= {
        "scene_number": unit.scene,
        "pictured": _is_pictured(unit),
        "portrayed": _is_portrayed(unit),
    }
    if isinstance(unit, SegmentationUnit | DesignUnit):
        return spec
    spec["measures"] = [
        {"name": m.name, "function": m.function, "command": m.command, "source": source_digest(m)}
        for m in unit.measures
    ]
    spec["series"] = unit.series
    if isinstance(unit, SceneUnit):
        spec["scene"] = msgspec.to_builtins(unit.experiment.scene_at(unit.series))
        spec.pop("sweep")
    return spec


def _is_pictured(unit: Unit) -> bool:
    if isinstance(unit, DesignUnit):
        return False
    return unit.scene < (1 if isinstance(unit, DrawingUnit) else unit.experiment.pictured)


def _is_portrayed(unit: Unit) -> bool:
    """Whether each rock's portrait is kept: not where no scene is to be pictured."""
    if isinstance(unit, SegmentationUnit | DesignUnit):
        return False
    return isinstance(unit, DrawingUnit) or unit.experiment.pictured > 0


def _true_centres(instances: NDArray[np.int32]) -> pd.DataFrame:
    """Return the centre of each instance's visible pixels, (instance, truth_row, truth_col)."""
    numbers = np.unique(instances[instances > 0])
    centres = ndi.center_of_mass(instances > 0, instances, numbers) if numbers.size else []
    table = pd.DataFrame(centres, columns=["truth_row", "truth_col"], dtype=np.float64)
    table.insert(0, "instance", numbers.astype(np.int64) - 1)
    return table


def _view_truth(
    scene: SceneTruth, view: int, instances: NDArray[np.int32], *, experiment: YardExperiment
) -> pd.DataFrame:
    """Return the truth of one view, one row a rock; `eligible` rocks stand in plain view."""
    rocks = pd.DataFrame([rock_columns(rock) for rock in scene.rocks])
    shown = pd.DataFrame(
        [
            view_columns(rock)
            | {
                "eligible": not rock.truncated
                and rock.visible_fraction >= experiment.min_visible_fraction,
            }
            for rock in scene.views[str(view)]
        ]
    )
    shown = shown.merge(_true_centres(instances), on="instance", how="left")
    return rocks.merge(shown, on="instance", how="inner")


@dataclass(frozen=True, eq=False)
class View:
    """One view with its truth, ready to be measured by every method."""

    place: Place  # with the method yet to be named
    observation: Observation
    given: NDArray[np.int32] | None  # labels (rows, cols), or None where rocks are to be found
    instances: NDArray[np.int32]
    truth: pd.DataFrame
    min_iou: float


def _measure_view(view: View, unit: MeasuredUnit) -> UnitResult:
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
        pictures=(whole_view(image, found[0], view.place),) if _is_pictured(unit) else (),
        backend="",
        portraits=portraits(image, found, view.instances, records, view.place)
        if _is_portrayed(unit)
        else (),
    )


def _scene_views(unit: SceneUnit, folder: Path) -> tuple[list[View], str]:
    experiment = unit.experiment
    scene_spec = experiment.scene_at(unit.series)
    spec = msgspec.structs.replace(scene_spec, seed=experiment.seed + unit.scene)
    backend = choose_backend(spec.renderer)
    write_scene(spec, 0, backend, folder)
    write_common(spec, backend, folder)
    camera = read_camera(folder / "camera.json")
    scene = folder / "000000"
    truth = read_scene_truth(scene / "scene_gt_shape.json")
    views = []
    for number in range(spec.views.count):
        name = f"{number:06d}.png"
        image = read_image(scene / "gray" / name)
        points_m = read_range(scene / "depth" / name, shape=image.shape, camera=camera)
        instances = read_instances(scene / "labels" / name)
        views.append(
            View(
                place=Place(
                    experiment.name, "yard", unit.series, unit.scene, spec.seed, number, ""
                ),
                observation=Observation(image=image, points_m=points_m, camera=camera),
                given=instances if experiment.labels == "true" else None,
                instances=instances,
                truth=_view_truth(truth, number, instances, experiment=experiment),
                min_iou=experiment.min_iou,
            )
        )
    return views, backend


def _drawing_view(unit: DrawingUnit, folder: Path) -> View:
    experiment = unit.experiment
    seed = experiment.seed + unit.scene
    write_series(unit.series, folder, count=experiment.count, seed=seed)
    image = read_image(folder / "image.png")
    return View(
        place=Place(experiment.name, "shapes", unit.series, unit.scene, seed, 0, ""),
        observation=Observation(image=image),
        given=read_labels(folder / "labels.png", shape=image.shape),
        instances=read_instances(folder / "labels.png"),
        truth=read_shape_truth(folder / "truth.csv").assign(eligible=True),
        min_iou=0.5,
    )


@contextmanager
def _data_folder() -> Iterator[Path]:
    """Name a folder for a unit's data that is gone after it."""
    with TemporaryDirectory(prefix="rockshape-") as parent:
        yield Path(parent) / "data"


def views_of(unit: MeasuredUnit) -> tuple[list[View], str]:
    """Make a unit's scene or drawing in a temporary folder; return its views and the renderer."""
    with _data_folder() as folder:
        if isinstance(unit, SceneUnit):
            return _scene_views(unit, folder)
        return [_drawing_view(unit, folder)], ""


def run_unit(unit: Unit) -> UnitResult:
    """Make, measure (or segment) and match one unit."""
    if isinstance(unit, SegmentationUnit):
        with _data_folder() as folder:
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
