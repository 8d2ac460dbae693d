"""Views: a unit's scene or drawing made in a temporary folder, and read back with its truth."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import msgspec
import numpy as np
import pandas as pd
import scipy.ndimage as ndi
from numpy.typing import NDArray

from rockshape.io import read_camera, read_image, read_labels, read_range
from rockshape.observation import Observation
from synth.dataset.write import write_common, write_scene
from synth.render import choose_backend
from synth.shapes import write_series
from validation.execution.units import DrawingUnit, MeasuredUnit, SceneUnit
from validation.records.join import RecordKey
from validation.records.truth import (
    SceneTruth,
    read_instances,
    read_scene_truth,
    read_shape_truth,
    rock_columns,
    view_columns,
)
from validation.suite.experiments import YardExperiment


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
class ViewCase:
    """One view with its truth, ready to be measured by every method."""

    place: RecordKey  # with the method yet to be named
    observation: Observation
    given: NDArray[np.int32] | None  # labels (rows, cols), or None where rocks are to be found
    instances: NDArray[np.int32]
    truth: pd.DataFrame
    min_iou: float


def _scene_views(unit: SceneUnit, folder: Path) -> tuple[list[ViewCase], str]:
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
            ViewCase(
                place=RecordKey(
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


def _drawing_view(unit: DrawingUnit, folder: Path) -> ViewCase:
    experiment = unit.experiment
    seed = experiment.seed + unit.scene
    write_series(unit.series, folder, count=experiment.count, seed=seed)
    image = read_image(folder / "image.png")
    return ViewCase(
        place=RecordKey(experiment.name, "shapes", unit.series, unit.scene, seed, 0, ""),
        observation=Observation(image=image),
        given=read_labels(folder / "labels.png", shape=image.shape).to_labels(),
        instances=read_instances(folder / "labels.png"),
        truth=read_shape_truth(folder / "truth.csv").assign(eligible=True),
        min_iou=0.5,
    )


@contextmanager
def data_folder() -> Iterator[Path]:
    """Name a folder for a unit's data that is gone after it."""
    with TemporaryDirectory(prefix="rockshape-") as parent:
        yield Path(parent) / "data"


def views_of(unit: MeasuredUnit) -> tuple[list[ViewCase], str]:
    """Make a unit's scene or drawing in a temporary folder; return its views and the renderer."""
    with data_folder() as folder:
        if isinstance(unit, SceneUnit):
            return _scene_views(unit, folder)
        return [_drawing_view(unit, folder)], ""
