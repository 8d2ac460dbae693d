"""Scene handle: a scene of a specification, rendered view by view on demand."""

from collections.abc import Mapping
from functools import cached_property
from operator import index as index_of
from pathlib import Path
from typing import TYPE_CHECKING, Any, SupportsIndex

from synth.camera.calibration import reported_camera
from synth.camera.camera import RenderCamera
from synth.camera.trajectories import camera_of
from synth.errors import SpecError
from synth.handle.client import call_in_worker
from synth.handle.jobs import BuiltScene, build, render, write
from synth.handle.options import with_noise
from synth.handle.truth import truth_table
from synth.handle.view import View
from synth.spec import SceneSpec

if TYPE_CHECKING:
    import pandas as pd

BUILD_TIMEOUT_S = 1800.0
RENDER_TIMEOUT_S = 600.0


class Scene:
    """Scene `index` of the dataset that a specification describes.

    Nothing is generated before it is asked for. The scene is built once; each view is rendered in
    a process of its own, which holds the OpenGL context and ends with it, and has exactly the
    values that the dataset's files have.
    """

    def __init__(self, spec: SceneSpec, *, index: int = 0) -> None:
        """Take a specification; see `make_scene`.

        Raises:
            SpecError: no scene of the dataset has that index.
        """
        if not 0 <= index < spec.scenes:
            raise SpecError(f"index: expected 0 to {spec.scenes - 1}, found {index}")
        self.spec, self.index = spec, index

    @property
    def view_count(self) -> int:
        """The number of views."""
        return self.spec.views.count

    @cached_property
    def camera(self) -> RenderCamera:
        """The camera of every view, with errors of calibration where the spec has them.

        Raises:
            SpecError: the lens folds the image inside the frame.
        """
        return reported_camera(self.spec, camera_of(self.spec.camera))

    @cached_property
    def truth(self) -> "pd.DataFrame":
        """Truth of the rocks themselves, one row each; `id` is the value in label images.

        Raises:
            SpecError: the rocks do not fit on the ground.
        """
        return truth_table(self._built.rocks)

    def render(
        self,
        view: int = 0,
        *,
        noise: str | Mapping[str, Any] | None = None,
        timeout_s: float = RENDER_TIMEOUT_S,
    ) -> View:
        """View number `view`, as the sensor captures it.

        `noise` names another sensor than the specification's (`none`, `stereo`, `sgm`, `mesh`,
        `tof`, `lidar` or one that is registered) or is a table with keys of [noise].

        Raises:
            SpecError: no such view or sensor, or the rocks do not fit on the ground.
            MissingBackendError: the machine lacks the renderer.
            RenderError: the rendering process failed, died or took longer than `timeout_s`.
        """
        if not isinstance(view, SupportsIndex):
            raise SpecError(f"view: expected a whole number, found {view!r}")
        view = index_of(view)
        if not 0 <= view < self.view_count:
            raise SpecError(f"view: expected 0 to {self.view_count - 1}, found {view}")
        spec = with_noise(self.spec, noise)
        parts = call_in_worker(
            render, spec, self.index, view, self._built.model, timeout_s=timeout_s
        )
        return View(
            image=parts.image,
            depth_m=parts.depth_m,
            exact_depth_m=parts.exact_depth_m,
            normals=parts.normals,
            not_rock=parts.not_rock,
            labels=parts.labels,
            camera=self.camera,
            pose=parts.pose,
            exact_camera=camera_of(self.spec.camera),
            exact_pose=parts.exact_pose,
            truth=truth_table(parts.rocks, parts.visible),
            pictures=parts.pictures,
            number=view,
            noise=spec.noise.kind,
        )

    def write(self, folder: str | Path, *, jobs: int = 1) -> None:
        """Write the dataset of the specification, all its scenes, into a folder.

        Raises:
            SpecError: the folder holds something else, or the rocks do not fit on the ground.
            MissingBackendError: the machine lacks the renderer.
            RenderError: the writing process failed or died.
        """
        call_in_worker(write, self.spec, Path(folder).absolute(), jobs, timeout_s=None)

    @cached_property
    def _built(self) -> BuiltScene:
        return call_in_worker(build, self.spec, self.index, timeout_s=BUILD_TIMEOUT_S)

    def __repr__(self) -> str:
        """Return rocks, views, camera, noise and seed."""
        spec = self.spec
        counted = spec.population.kind == "count"
        rocks = f"{spec.rocks.count} rocks" if counted else f"population {spec.population.kind!r}"
        return (
            f"Scene({rocks}, {self.view_count} views, camera {spec.camera.preset!r}, "
            f"noise {spec.noise.kind!r}, seed {spec.seed})"
        )
