"""One view of rocks as each range sensor measures it."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synth.camera.camera import RenderCamera
from synth.dataset.write import capture_frame
from synth.light import light_scene
from synth.render import open_renderer
from synth.scene.scene import build_scene
from synth.spec import convert_spec

Floats = NDArray[np.float64]

# By name, the table [noise]. At 3 m a disparity of 0.1 px is 6 mm for this camera.
STEREO = {"disparity_px": 0.1, "window_px": 7}
SENSORS: dict[str, dict[str, Any]] = {
    "stereo": {"kind": "stereo", **STEREO},
    "stereo, windows bleed": {"kind": "stereo", "fattening": 1.0, **STEREO},
    "mesh, adaptive": {"kind": "mesh", "fattening": 1.0, **STEREO},
    "mesh, regular": {
        "kind": "mesh",
        "fattening": 1.0,
        "options": {"layout": "regular"},
        **STEREO,
    },
    "tof": {"kind": "tof", "options": {"footprint_px": 3.0}},
    "lidar": {"kind": "lidar"},
}
# As near as the Pathfinder products look, with their camera.
SCENE: dict[str, Any] = {
    "rocks": {"count": 7, "diameter_m": [0.07, 0.2], "spacing": 1.1},
    "camera": {"preset": "imp", "distance_m": 3.2, "elevation_deg": 26.0},
    "views": {"count": 1},
    "renderer": "embree",
}


@dataclass(frozen=True, eq=False)
class Measured:
    """A view as one sensor measures it."""

    name: str  # of the sensor in the table
    image: NDArray[np.uint8]  # (rows, cols)
    exact_m: Floats  # (rows, cols), z-depth
    depth_m: Floats  # likewise, as measured; NaN in holes
    camera: RenderCamera

    def points_m(self) -> Floats:
        """Measured points in the camera's frame, (rows, cols, 3)."""
        camera = self.camera
        across = (np.arange(camera.width) - camera.cx)[None, :] / camera.fx * self.depth_m
        down = (np.arange(camera.height) - camera.cy)[:, None] / camera.fy * self.depth_m
        return np.stack([across, down, self.depth_m], axis=-1)


def measured_views(seed: int) -> Iterator[Measured]:
    """Yield one view of a scene by each sensor."""
    spec = convert_spec({**SCENE, "seed": seed}, where="scene")
    scene = build_scene(spec, 0)
    stage = light_scene(scene, spec.sun, spec.surface)
    renderer = open_renderer("embree", stage, scene.camera)
    for name, noise in SENSORS.items():
        one = convert_spec({**SCENE, "seed": seed, "noise": noise}, where=name)
        view, capture = capture_frame(one, 0, 0, scene=scene, stage=stage, renderer=renderer)
        yield Measured(name, view.image, view.depth_m, capture.depth_m, scene.camera)
