"""Made views as the command line reads them: dataset files written and read back."""

import json
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.io import read_image, read_range
from rockshape.observation import Observation
from synth.camera.trajectories import camera_of
from synth.dataset.depth import depth_scale_mm
from synth.dataset.write import write_scene
from synth.render import choose_backend
from synth.spec import SceneSpec
from validation.records.truth import read_instances


@dataclass(frozen=True, eq=False)
class MadeView:
    """A view of a made scene: what is observed, the true labels and the true rocks."""

    observation: Observation
    exact: Observation  # with the range free of noise
    labels: NDArray[np.integer[Any]]
    rocks: list[dict[str, Any]]  # of the scene, by instance
    seen: dict[int, dict[str, Any]]  # of this view, by instance


def made_views(spec: SceneSpec, index: int = 0) -> Iterator[MadeView]:
    """Yield the views of a scene of a spec."""
    with tempfile.TemporaryDirectory() as parent:
        folder = Path(parent) / "data"
        write_scene(spec, index, choose_backend(spec.renderer), folder)
        eye, data = camera_of(spec.camera), folder / f"{index:06d}"
        scale_mm = depth_scale_mm(spec)
        camera = Camera(eye.fx, eye.fy, eye.cx, eye.cy, eye.width, eye.height, scale_mm)
        exact = "depth_true" if (data / "depth_true").exists() else "depth"
        truth = json.loads((data / "scene_gt_shape.json").read_text(encoding="utf-8"))
        for view, rocks in truth["views"].items():
            name = f"{int(view):06d}.png"
            image = read_image(data / "gray" / name)
            seen = [
                Observation(
                    image=image,
                    points_m=read_range(data / kind / name, shape=image.shape, camera=camera),
                    camera=camera,
                )
                for kind in ("depth", exact)
            ]
            yield MadeView(
                observation=seen[0],
                exact=seen[1],
                labels=read_instances(data / "labels" / name),
                rocks=truth["rocks"],
                seen={rock["instance"]: rock for rock in rocks},
            )
