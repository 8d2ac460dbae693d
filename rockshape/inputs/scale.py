"""Scale of a photograph: the side of a pixel on what is seen, or a scale bar in it."""

import math
import re
from dataclasses import replace

from rockshape.errors import InputError
from rockshape.observation import Observation
from rockshape.point_grid.units import parse_length
from rockshape.rock.level_ground import LevelGround

_NUMBER = r"\s*([+-]?(?:\d+\.?\d*|\.\d+))\s*"
_BAR = re.compile(f"{_NUMBER},{_NUMBER}:{_NUMBER},{_NUMBER}=(.+)", re.DOTALL)
_WHAT = "scale (--scale)"


def parse_scale(text: str) -> float:
    """Side of a pixel, m, from `0.39mm`, or from two ends of a scale bar, `40,52:540,52=100mm`.

    Raises: InputError for anything else.
    """
    bar = _BAR.fullmatch(text)
    if bar is None:
        return parse_length(text, what=_WHAT, example="0.39mm or 40,52:540,52=100mm for a bar")
    x1, y1, x2, y2 = (float(number) for number in bar.groups()[:4])
    length_px = math.hypot(x2 - x1, y2 - y1)
    if length_px == 0:
        raise InputError(f"{_WHAT}: expected two different ends of a bar, found {text!r}")
    return parse_length(bar.group(5), what=_WHAT, example="40,52:540,52=100mm") / length_px


def with_scale(
    observation: Observation, *, scale: str | None, level_ground: LevelGround | None
) -> Observation:
    """Observation with a scale that was told; itself without one.

    Raises: InputError for two scales, one beside range, which tells it, and level ground without a
        camera.
    """
    if scale is None and level_ground is None:
        return observation
    if scale is not None and level_ground is not None:
        raise InputError("scale (--scale): expected no camera height beside it, found both")
    if observation.points_m is not None:
        told = "scale (--scale)" if scale is not None else "level_ground (--camera-height)"
        raise InputError(f"{told}: expected no range beside it, which tells lengths, found both")
    if scale is not None:
        return replace(observation, pixel_size_m=parse_scale(scale))
    if observation.camera is None:
        raise InputError("level_ground (--camera-height): expected a camera (--camera), found none")
    return replace(observation, level_ground=level_ground)
