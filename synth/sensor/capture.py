"""One view as the sensor has it: picture and range, and the right eye's picture where matched."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synth.camera.camera import Pose, RenderCamera, right_eye
from synth.light import Stage
from synth.render.interface import Renderer
from synth.render.view import RenderedView, render_light
from synth.sensor.exposure import Picture, eight_bits, take_picture
from synth.sensor.rectify import Bytes, Rectification, rectification_of
from synth.sensor.rig import rig_of
from synth.sensor.seeds import Use, stream
from synth.sensor.sgm import matched_disparity_px, search_range_px
from synth.sensor.stereo import modelled_depth_m
from synth.spec import SceneSpec
from synth.spec.sensor import SensorSpec

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Capture:
    """What the sensor measured in one view."""

    picture: Picture  # (rows, cols), 8 bits, or 12 in the upper bits of 16
    depth_m: Floats  # (rows, cols), NaN in holes
    right_picture: Picture | None  # the right eye's, where two pictures were matched


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
    """Return what the sensor makes of view `number` of a scene, a function of spec and numbers.

    Each use of chance has a stream of its own, so that range noise does not change the picture.
    """

    def chance(use: Use) -> np.random.Generator:
        return stream(use, seed=spec.seed, scene=scene, view=number)

    noise, sensor = spec.noise, spec.sensor
    ideal = sensor == SensorSpec()
    picture = view.image if ideal else take_picture(view.light, sensor, rng=chance(Use.PICTURE))
    if noise.kind == "none":
        return Capture(picture=picture, depth_m=view.depth_m, right_picture=None)
    rig = rig_of(spec.camera.preset)
    lens = None if camera.distortion is None else rectification_of(camera)
    if noise.kind == "stereo":
        exposed = sensor.exposure * view.light
        depth_m = modelled_depth_m(
            view.depth_m, exposed, rig, noise, rng=chance(Use.DISPARITY), lens=lens
        )
        return Capture(picture=picture, depth_m=depth_m, right_picture=None)
    light = render_light(
        renderer,
        stage,
        camera,
        right_eye(pose, rig.baseline_m),
        supersample=spec.camera.supersample,
    )
    right = take_picture(light, sensor, rng=chance(Use.RIGHT_PICTURE))
    disparity_px = _matched_px(
        eight_bits(picture),
        eight_bits(right),
        exact_px=rig.disparity_px(view.depth_m),
        window_px=noise.window_px,
        lens=lens,
    )
    return Capture(picture=picture, depth_m=rig.depth_m(disparity_px), right_picture=right)


def _matched_px(
    left: Bytes, right: Bytes, *, exact_px: Floats, window_px: int, lens: Rectification | None
) -> Floats:
    """Return the disparity of two pictures, (rows, cols), matched where the lens's are straight.

    The scene's own disparities set the range that is searched.
    """
    least_px, count = search_range_px(exact_px)
    if lens is None:
        return matched_disparity_px(
            left, right, least_px=least_px, count=count, window_px=window_px
        )
    found_px = matched_disparity_px(
        lens.straight_picture(left),
        lens.straight_picture(right),
        least_px=least_px,
        count=count,
        window_px=window_px,
    )
    found_px[~lens.seen | lens.outside_right(found_px)] = np.nan
    return lens.bent_disparity_px(found_px)
