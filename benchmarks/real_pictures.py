"""Photographs that made pictures are compared with, by kind, and the made ones."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from skimage import data

from synth.bed.make import make_tile
from synth.camera.camera import Pose
from synth.light import light_scene
from synth.render import open_renderer, render_view
from synth.scene.scene import build_scene
from synth.sensor.exposure import eight_bits, take_picture
from synth.spec import SceneSpec, convert_spec
from synth.spec.bed import BedSpec

Bytes = NDArray[np.uint8]

EXAMPLES = Path(__file__).parent.parent / "examples"


@dataclass(frozen=True)
class Photograph:
    """Real picture."""

    name: str
    read: Callable[[], Bytes]
    held_out: bool  # neither the classifier is trained on it nor a generator fitted to it


def _file(path: str) -> Callable[[], Bytes]:
    def read() -> Bytes:
        picture = cv2.imread(str(EXAMPLES / path))
        return np.ascontiguousarray(picture[..., ::-1])

    return read


def _scikit_gravel() -> Bytes:
    return np.repeat(data.gravel()[..., None], 3, axis=-1)


PHOTOGRAPHS: dict[str, tuple[Photograph, ...]] = {
    "gravel": (
        Photograph("river gravel 1", _file("grains/1_P1060330_1.jpg"), held_out=False),
        Photograph("Barton Creek", _file("photos/barton_creek_part.jpg"), held_out=False),
        Photograph("river gravel 2", _file("grains/2_P1060338_0.jpg"), held_out=True),
        Photograph("crushed stone", _scikit_gravel, held_out=True),
    ),
    "Mars": (
        Photograph("Curiosity 332", _file("photos/msl_332_part.jpg"), held_out=False),
        Photograph("Pathfinder i944014", _file("mars/i944014r.png"), held_out=False),
        Photograph("Pathfinder i925510", _file("photos/i925510_half.png"), held_out=False),
        Photograph("Curiosity 538", _file("photos/msl_538_part.jpg"), held_out=True),
        Photograph("Spirit", _file("photos/spirit_navcam_part.jpg"), held_out=True),
    ),
}


def bed_pictures(numbers: range) -> Iterator[Bytes]:
    """Yield gravel beds with every key at its default, the tiles of such numbers."""
    spec = BedSpec(seed=0)
    for number in numbers:
        yield make_tile(spec, number).image


# Polyhedra on an even, level ground: the plain scene.
PLAIN: dict[str, Any] = {
    "rocks": {"count": 6},
    "camera": {"preset": "imp"},
    "views": {"count": 1},
    "renderer": "embree",
}


def plain_pictures(numbers: range) -> Iterator[Bytes]:
    """Yield pictures of plain scenes of such seeds."""
    for seed in numbers:
        yield scene_picture(convert_spec({**PLAIN, "seed": seed}, where="plain"))


def scene_picture(spec: SceneSpec) -> Bytes:
    """Picture (rows, cols, 3) of a scene's first view, as its sensor takes it."""
    scene = build_scene(spec, 0)
    stage = light_scene(scene, spec.sun, spec.surface)
    renderer = open_renderer("embree", stage, scene.camera)
    pose: Pose = scene.poses[0]
    view = render_view(renderer, stage, scene.camera, pose, supersample=spec.camera.supersample)
    rng = np.random.default_rng(spec.seed)
    picture = eight_bits(take_picture(view.light, spec.sensor, rng=rng))
    return np.repeat(picture[..., None], 3, axis=-1)
