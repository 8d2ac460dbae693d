"""Sensor record: how a view is captured, which images it adds, and what it needs."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from msgspec import Struct

from synth.arrays import Floats, Singles
from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.errors import SpecError
from synth.light import Stage
from synth.render.interface import Renderer
from synth.render.view import RenderedView, render_light
from synth.sensor.development import Development, blurred, toned
from synth.sensor.exposure import Picture, take_picture
from synth.sensor.seeds import Use, stream
from synth.spec import SceneSpec
from synth.spec.sensor import SENSORS

# Folders of a scene that every dataset has; a sensor's own have other names.
COMMON_FOLDERS = (
    "gray",
    "rgb",
    "normals",
    "not_rock",
    "depth",
    "depth_true",
    "range",
    "labels",
    "mask",
    "mask_visib",
    "models",
)


@dataclass(frozen=True, eq=False)
class Capture:
    """Measurement of one view by a sensor."""

    picture: Picture  # (rows, cols), 8 bits, or 12 in the upper bits of 16
    depth_m: Floats  # (rows, cols), z-depth of the pixels' centres, NaN in holes
    pictures: Mapping[str, Picture] = field(default_factory=dict)  # further ones, by folder
    colour: Picture | None = None  # (rows, cols, 3) red, green, blue; never the sensor's own


@dataclass(frozen=True, eq=False)
class SensorInput:
    """Input of a sensor: the exact view, its image, and the scene to see more of."""

    view: RenderedView
    picture: Picture  # (rows, cols), the image as exposed, with the sensor's noise
    pose: Pose
    camera: RenderCamera
    spec: SceneSpec
    scene: int  # index of the scene in its dataset
    number: int  # of the view in its scene
    stage: Stage
    renderer: Renderer
    development: Development  # of all pictures of this view
    options: Any  # of the sensor's own struct; None where it has none

    def random(self, use: Use | str) -> np.random.Generator:
        """Random numbers of one use in this view, independent of every other use's."""
        return stream(use, seed=self.spec.seed, scene=self.scene, view=self.number)

    def picture_from(self, pose: Pose, use: Use | str) -> Picture:
        """Image, (rows, cols), that the same camera exposes at another pose."""
        light = render_light(
            self.renderer,
            self.stage,
            self.camera,
            pose,
            supersample=self.spec.camera.supersample,
        )
        return take_picture(
            light, self.spec.sensor, rng=self.random(use), development=self.development
        )

    def exposed_light(self) -> Singles:
        """Light of the view as exposed and toned, without noise, (rows, cols), 1 for white."""
        light = blurred(self.view.light, self.development)
        exposed = self.spec.sensor.exposure * self.development.gain * light
        if self.development.tone == "linear":
            return exposed
        return toned(exposed.astype(np.float64), self.development).astype(np.float32)


@dataclass(frozen=True, eq=False)
class Sensor:
    """Range sensor.

    `capture` is a function of a view, its random numbers and the options alone.
    """

    name: str
    title: str  # one line, for lists
    capture: Callable[[SensorInput], Capture]
    pictures: tuple[str, ...] = ()  # folders of images that it adds to a scene
    exact_range: bool = False  # its depth is the truth: no depth_true beside it
    needs_baseline: bool = False  # of the camera preset: a second eye
    options: type[Struct] | None = None  # of the table [noise.options]

    def folders(self) -> tuple[str, ...]:
        """Folders of a scene's images: what is measured, and the exact depth beside it."""
        exact = () if self.exact_range else ("depth_true",)
        return ("gray", "depth", *exact, *self.pictures)


def find_sensor(name: str) -> Sensor:
    """Sensor of a name.

    Raises:
        SpecError: no sensor has the name, or what has it is no `Sensor`.
    """
    return SENSORS.find_kind(name, Sensor)


def register_sensor(sensor: Sensor) -> Sensor:
    """Add a sensor to this process and to the worker processes that it starts.

    Raises:
        SpecError: the name is taken by a sensor of the package or of an entry point, or a folder
            by the dataset's own images.
    """
    taken = [name for name in sensor.pictures if name in COMMON_FOLDERS]
    if taken:
        raise SpecError(
            f"sensor {sensor.name!r}: pictures: expected folders beside the dataset's own, "
            f"found {taken[0]!r}"
        )
    SENSORS.register(sensor)
    return sensor
