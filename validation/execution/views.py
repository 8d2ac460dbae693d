"""View of a rendered scene: the observation that a camera makes, with the truth about its rocks.

The one place that turns a scene into what is measured. `dataset_views` goes through the files of a
dataset, as a user would; `captured_view` takes a capture as it is.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pandas as pd
import scipy.ndimage as ndi
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.fusion.pose import CameraPose
from rockshape.io import read_camera, read_image, read_range
from rockshape.observation import Observation
from synth.camera.calibration import calibrated
from synth.camera.camera import RenderCamera
from synth.dataset.common import write_common
from synth.dataset.write import write_scene
from synth.render import choose_backend
from synth.render.view import RenderedView
from synth.sensor.sensor import Capture, find_sensor
from synth.spec import SceneSpec
from validation.records.truth import (
    RockInView,
    SceneTruth,
    read_instances,
    read_poses,
    read_scene_truth,
    rock_columns,
    view_columns,
)


@dataclass(frozen=True, eq=False)
class SceneView:
    """One view of a scene."""

    number: int
    image: NDArray[np.float32]  # (rows, cols), 0..1
    camera: Camera
    points_m: NDArray[np.float64]  # (rows, cols, 3) in the camera frame, as the sensor has them
    exact_m: NDArray[np.float64]  # (rows, cols, 3), without noise
    instances: NDArray[np.int32]  # (rows, cols), rock i as i + 1
    rocks: tuple[RockInView, ...]  # what the view shows of each
    truth: pd.DataFrame  # one row a rock: its own truth and that of the view
    reported_pose: CameraPose | None = None  # None of a capture, as the true one
    true_pose: CameraPose | None = None

    def observation(self, points_m: NDArray[np.float64] | None) -> Observation:
        """View with range as given, or without any."""
        return Observation(image=self.image, points_m=points_m, camera=self.camera)


def dataset_views(spec: SceneSpec, *, exact: bool = False) -> tuple[list[SceneView], str]:
    """Views of scene 0 of a spec, written and read back, and the renderer.

    With `exact`, exact range is read too where the sensor's has noise; otherwise it is the same.
    """
    backend, sensor = choose_backend(spec.renderer), find_sensor(spec.noise.kind)
    with _data_folder() as folder:
        write_scene(spec, 0, backend, folder)
        write_common(spec, backend, folder)
        camera = read_camera(folder / "camera.json")
        scene = folder / "000000"
        truth = read_scene_truth(scene / "scene_gt_shape.json")
        poses = read_poses(scene / "scene_camera.json")
        true_poses = poses
        if calibrated(spec):
            true_poses = read_poses(scene / "scene_gt_camera.json")
        exact_folder = "depth_true" if exact and not sensor.exact_range else "depth"
        views = []
        for number in range(spec.views.count):
            name = f"{number:06d}.png"
            image = read_image(scene / "gray" / name)
            points_m = read_range(scene / "depth" / name, shape=image.shape, camera=camera)
            exact_m = points_m
            if exact_folder != "depth":
                exact_m = read_range(scene / exact_folder / name, shape=image.shape, camera=camera)
            view = _view(
                number,
                image,
                camera=camera,
                ranges_m=(points_m, exact_m),
                instances=read_instances(scene / "labels" / name),
                truth=truth,
            )
            views.append(replace(view, reported_pose=poses[number], true_pose=true_poses[number]))
    return views, backend


def captured_view(
    number: int, lens: RenderCamera, rendered: RenderedView, capture: Capture, truth: SceneTruth
) -> SceneView:
    """View from the renderer's exact depth and labels and what the sensor made of them."""
    white = np.iinfo(capture.picture.dtype).max
    camera = Camera(lens.fx, lens.fy, lens.cx, lens.cy, lens.width, lens.height)
    return _view(
        number,
        (capture.picture / white).astype(np.float32),
        camera=camera,
        ranges_m=(camera.unproject(capture.depth_m), camera.unproject(rendered.depth_m)),
        instances=rendered.labels.astype(np.int32),
        truth=truth,
    )


def _view(
    number: int,
    image: NDArray[np.float32],
    *,
    camera: Camera,
    ranges_m: tuple[NDArray[np.float64], NDArray[np.float64]],
    instances: NDArray[np.int32],
    truth: SceneTruth,
) -> SceneView:
    rocks = truth.views[str(number)]
    shown = pd.DataFrame([view_columns(rock) for rock in rocks])
    shown = shown.merge(_true_centres(instances), on="instance", how="left")
    own = pd.DataFrame([rock_columns(rock) for rock in truth.rocks])
    return SceneView(
        number=number,
        image=image,
        camera=camera,
        points_m=ranges_m[0],
        exact_m=ranges_m[1],
        instances=instances,
        rocks=rocks,
        truth=own.merge(shown, on="instance", how="inner"),
    )


def _true_centres(instances: NDArray[np.int32]) -> pd.DataFrame:
    """Centre of each instance's visible pixels, (instance, truth_row, truth_col)."""
    numbers = np.unique(instances[instances > 0])
    centres = ndi.center_of_mass(instances > 0, instances, numbers) if numbers.size else []
    table = pd.DataFrame(centres, columns=["truth_row", "truth_col"], dtype=np.float64)
    table.insert(0, "instance", numbers.astype(np.int64) - 1)
    return table


def with_eligibility(truth: pd.DataFrame, *, min_visible_fraction: float) -> pd.DataFrame:
    """View's truth with the column `eligible`: wholly in the frame and in plain view."""
    eligible = ~truth["truth_truncated"].astype(bool)
    eligible &= truth["truth_visible_fraction"] >= min_visible_fraction
    told = truth.copy()
    told.insert(list(truth.columns).index("truth_row"), "eligible", eligible)
    return told


@contextmanager
def _data_folder() -> Iterator[Path]:
    """Name a folder for a unit's data that is gone after it."""
    with TemporaryDirectory(prefix="rockshape-") as parent:
        yield Path(parent) / "data"
