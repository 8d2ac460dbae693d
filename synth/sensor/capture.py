"""Capture of one view by the sensor of a spec."""

from dataclasses import replace

from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.camera.presets import PRESETS
from synth.errors import SpecError
from synth.light import Stage
from synth.render.interface import Renderer
from synth.render.view import RenderedView
from synth.sensor.development import Development, draw_development
from synth.sensor.exposure import Picture, take_picture
from synth.sensor.seeds import Use, stream
from synth.sensor.sensor import Capture, Sensor, SensorInput, find_sensor
from synth.spec import SceneSpec, image_of
from synth.spec.registry import options_of
from synth.spec.sensor import SensorSpec


def sensor_of(spec: SceneSpec) -> Sensor:
    """Sensor of a spec, which its camera preset can carry.

    Raises:
        SpecError: the sensor needs two eyes and the preset has one.
    """
    sensor = find_sensor(spec.noise.kind)
    if sensor.needs_baseline and PRESETS[spec.camera.preset].baseline_m is None:
        raise SpecError(
            f"noise.kind: expected a preset with two eyes for {sensor.name!r}, "
            f"found {spec.camera.preset!r}"
        )
    return sensor


def capture_view(
    view: RenderedView,
    pose: Pose,
    *,
    spec: SceneSpec,
    scene: int,
    number: int,
    camera: RenderCamera,
    stage: Stage,
    renderer: Renderer,
) -> Capture:
    """Capture of view `number` of a scene, a function of spec and numbers.

    Each use of chance has a stream of its own, so that range noise does not change the image. A
    view in colour is taken a second time, by a colour camera in the same place.

    Raises:
        SpecError: the sensor's capture is not of its own folders or of the view's size.
    """
    sensor = sensor_of(spec)
    picture: Picture = view.image
    development = draw_development(spec, scene=scene, view=number)
    if spec.sensor != SensorSpec() or development != Development():
        chance = stream(Use.PICTURE, seed=spec.seed, scene=scene, view=number)
        picture = take_picture(view.light, spec.sensor, rng=chance, development=development)
    capture = sensor.capture(
        SensorInput(
            view=view,
            picture=picture,
            pose=pose,
            camera=camera,
            spec=spec,
            scene=scene,
            number=number,
            stage=stage,
            renderer=renderer,
            development=development,
            options=options_of("sensor", sensor, spec.noise.options),
        )
    )
    _check(capture, sensor, view)
    if view.colour is None or not image_of(spec).colour:
        return capture
    chance = stream(Use.COLOUR, seed=spec.seed, scene=scene, view=number)
    colour = take_picture(view.colour, spec.sensor, rng=chance, development=development)
    return replace(capture, colour=colour)


def _check(capture: Capture, sensor: Sensor, view: RenderedView) -> None:
    """Raise SpecError where a sensor does not return what its record says."""
    if set(capture.pictures) != set(sensor.pictures):
        raise SpecError(
            f"sensor {sensor.name!r}: pictures: expected {sorted(sensor.pictures)}, "
            f"found {sorted(capture.pictures)}"
        )
    if capture.depth_m.shape != view.depth_m.shape:
        raise SpecError(
            f"sensor {sensor.name!r}: depth_m: expected (rows, cols) {view.depth_m.shape}, "
            f"found {capture.depth_m.shape}"
        )
