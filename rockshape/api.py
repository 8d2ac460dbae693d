"""Measurement of arrays: from pixels and range to the measures of each rock in one call."""

from dataclasses import replace

from numpy.typing import ArrayLike

from rockshape.camera.camera import CameraLike
from rockshape.errors import InputError
from rockshape.inputs.arrays import observe
from rockshape.inputs.scale import with_scale
from rockshape.measurement import Measurement
from rockshape.method import Method
from rockshape.numerics.array_argument import array_argument
from rockshape.observation import Observation
from rockshape.pipeline import measure as measure_observation
from rockshape.rock.given_labels import instances_of
from rockshape.rock.instances import Instances
from rockshape.rock.level_ground import LevelGround
from rockshape.rock.pieces import Pieces
from rockshape.segmentation.finders import Finder


def measure(
    image: ArrayLike | Observation | None = None,
    *,
    range_m: ArrayLike | None = None,
    range_unit: str | None = None,
    right: ArrayLike | None = None,
    camera: CameraLike | None = None,
    labels: ArrayLike | Instances | None = None,
    pieces: Pieces = "split",
    ignore: ArrayLike | None = None,
    method: str | Method = "robust",
    find: str | Finder | None = None,
    descriptors: bool = False,
    sizes: bool = False,
    scale: str | None = None,
    level_ground: LevelGround | None = None,
) -> Measurement:
    """Find the rocks in one image and measure each.

    - image: (rows, cols) or (rows, cols, 3), of 8 or 16 bits or floats from 0 to 1; or an
      Observation, as `rockshape.read` returns, which brings its own range and camera. It may be
      left out where range or labels are given.
    - range_m: points (rows, cols, 3) in the camera frame, or z-depth (rows, cols) with a camera;
      metres. NaN, infinity, a z-depth of 0, the point (0, 0, 0) and what is masked are no
      measurement.
    - range_unit: unit of range_m in place of metres, `mm` or `0.25mm` say; any distance is then
      believed. Without it a median distance below 1 cm or above 200 m is refused.
    - right: right picture of a rectified stereo pair, in place of range; the image is the left one,
      and its camera has `baseline_m` and may have `disparity_offset`, px.
    - camera: what took the image, any object or mapping with fx, fy, cx, cy in pixels. Needed for
      z-depth; else found from the points.
    - labels: rocks outlined already: (rows, cols) of whole numbers, 0 the ground, or Instances.
    - pieces: what becomes of labels with a single value in several pieces, a mask without ids:
      `split` makes each piece a rock, `keep` keeps one rock.
    - ignore: mask (rows, cols), true or not 0 where no rock is to be found: hardware, sky.
    - method: what is measured: `robust`, `paper`, another name in `rockshape.method.methods()`, or
      a Method.
    - find: how rocks are found: `range`, `image`, `both` or `published`, or a Finder; else as the
      method does.
    - descriptors: whether each rock gets the descriptors of its outline too.
    - sizes: whether each gets its axes, Feret diameters and area, in px and, by range or a scale,
      in mm.
    - scale: side of a pixel on what is seen, `0.39mm`, or two ends of a scale bar,
      `40,52:540,52=100mm`; then sizes are told.
    - level_ground: height and tilt of the camera above level ground; then sizes are told. It needs
      a camera.

    Nothing that is given is changed. Without range, measures that need it are NaN with a reason.
    Raises: InputError where arrays do not fit each other, and where rocks are to be found by range
        and there is none.
    """
    given = None if labels is None else instances_of(labels, pieces)
    if isinstance(image, Observation):
        if any(each is not None for each in (range_m, range_unit, right, camera)):
            raise InputError("measure: expected an Observation's own range and camera, not both")
        observation = image
    else:
        observation = observe(
            image,
            range_m=range_m,
            range_unit=range_unit,
            right=right,
            camera=camera,
            labels=given,
        )
    observation = with_scale(observation, scale=scale, level_ground=level_ground)
    if ignore is not None:
        observation = replace(observation, ignored=array_argument("ignore", ignore) != 0)
    return measure_observation(
        observation,
        method=method,
        find=find,
        labels=given,
        descriptors=descriptors,
        sizes=sizes or scale is not None or level_ground is not None,
    )
