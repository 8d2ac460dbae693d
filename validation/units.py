"""Work units: one scene or one drawing made, measured and matched, a pure function of its spec."""

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import msgspec
import pandas as pd

from rockshape.draw import overlay
from rockshape.io import read_camera, read_image, read_labels, read_range
from rockshape.observation import Observation
from rockshape.pipeline import measure
from synth.dataset import write_common, write_scene
from synth.render import choose_backend
from synth.shapes import write_series
from validation.pictures import Picture, compress
from validation.records import Place, join
from validation.suite import ShapesExperiment, Suite, YardExperiment
from validation.truth import (
    SceneTruth,
    read_instances,
    read_scene_truth,
    read_shape_truth,
    rock_columns,
)


@dataclass(frozen=True)
class SceneUnit:
    """Scene number `scene` of an experiment of rocks."""

    experiment: YardExperiment
    scene: int


@dataclass(frozen=True)
class DrawingUnit:
    """Drawing number `scene` of one series of an experiment of shapes."""

    experiment: ShapesExperiment
    series: str
    scene: int


Unit = SceneUnit | DrawingUnit


@dataclass(frozen=True, eq=False)
class UnitResult:
    """What became of a unit."""

    records: pd.DataFrame  # one row a view and rock: true, found or both
    pictures: tuple[Picture, ...]
    backend: str  # the renderer, empty for drawings


def units_of(suite: Suite) -> tuple[Unit, ...]:
    """Return all units of a suite, in the order of their records."""
    units: list[Unit] = []
    for experiment in suite.experiments:
        if isinstance(experiment, YardExperiment):
            units += [SceneUnit(experiment, scene) for scene in range(experiment.scenes)]
        else:
            units += [
                DrawingUnit(experiment, series, drawing)
                for series in experiment.series
                for drawing in range(experiment.drawings)
            ]
    return tuple(units)


def describe(unit: Unit) -> str:
    """Return a unit's name for the progress."""
    series = f" {unit.series}" if isinstance(unit, DrawingUnit) else ""
    return f"{unit.experiment.name}{series} {unit.experiment.seed + unit.scene}"


def _view_truth(scene: SceneTruth, view: int, *, experiment: YardExperiment) -> pd.DataFrame:
    """Return the truth of one view, one row a rock; `eligible` rocks stand in plain view."""
    rocks = pd.DataFrame([rock_columns(rock) for rock in scene.rocks])
    shown = pd.DataFrame(
        [
            {
                "instance": rock.instance,
                "truth_visible_fraction": rock.visible_fraction,
                "truth_truncated": rock.truncated,
                "truth_pixel_m": rock.pixel_m,
                "eligible": not rock.truncated
                and rock.visible_fraction >= experiment.min_visible_fraction,
            }
            for rock in scene.views[str(view)]
        ]
    )
    return rocks.merge(shown, on="instance", how="inner")


def _run_scene(unit: SceneUnit, folder: Path) -> UnitResult:
    experiment = unit.experiment
    spec = msgspec.structs.replace(experiment.scene, seed=experiment.seed + unit.scene)
    backend = choose_backend(spec.renderer)
    write_scene(spec, 0, backend, folder)
    write_common(spec, backend, folder)
    camera = read_camera(folder / "camera.json")
    scene = folder / "000000"
    truth = read_scene_truth(scene / "scene_gt_shape.json")
    records, pictures = [], []
    for view in range(spec.views.count):
        name = f"{view:06d}.png"
        image = read_image(scene / "gray" / name)
        points_m = read_range(scene / "depth" / name, shape=image.shape, camera=camera)
        found = measure(
            Observation(image=image, points_m=points_m, camera=camera), method=experiment.method
        )
        place = Place(experiment.name, "yard", "", unit.scene, spec.seed, view)
        records.append(
            join(
                place,
                _view_truth(truth, view, experiment=experiment),
                read_instances(scene / "labels" / name),
                found,
                min_iou=experiment.min_iou,
            )
        )
        if unit.scene < experiment.pictured:
            pictures.append(Picture(place, *compress(overlay(image, found), found.labels)))
    return UnitResult(pd.concat(records, ignore_index=True), tuple(pictures), backend)


def _run_drawing(unit: DrawingUnit, folder: Path) -> UnitResult:
    experiment = unit.experiment
    seed = experiment.seed + unit.scene
    write_series(unit.series, folder, count=experiment.count, seed=seed)
    image = read_image(folder / "image.png")
    labels = read_labels(folder / "labels.png", shape=image.shape)
    found = measure(Observation(image=image), method=experiment.method, labels=labels)
    place = Place(experiment.name, "shapes", unit.series, unit.scene, seed, 0)
    truth = read_shape_truth(folder / "truth.csv").assign(eligible=True)
    instances = read_instances(folder / "labels.png")
    records = join(place, truth, instances, found, min_iou=0.5)
    pictures: tuple[Picture, ...] = ()
    if unit.scene == 0:
        pictures = (Picture(place, *compress(overlay(image, found), found.labels)),)
    return UnitResult(records, pictures, "")


def run_unit(unit: Unit) -> UnitResult:
    """Make, measure and match one unit in a temporary folder that is gone afterwards."""
    with TemporaryDirectory(prefix="rockshape-") as parent:
        folder = Path(parent) / "data"
        if isinstance(unit, SceneUnit):
            return _run_scene(unit, folder)
        return _run_drawing(unit, folder)
