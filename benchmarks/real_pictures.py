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
from synth.camera.pose import Pose
from synth.light.spec_stage import spec_stage
from synth.render import open_renderer, render_view
from synth.scene.scene import build_scene
from synth.sensor.development import draw_development
from synth.sensor.exposure import eight_bits, take_picture
from synth.spec import SceneSpec, convert_spec
from synth.spec.bed import BedSpec
from synth.spec.site import SITES, with_site

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


# What the rough sites have in common: rocks in sight of a lander's or a rover's camera.
SITE: dict[str, Any] = {
    "rocks": {"count": 3, "diameter_m": [0.12, 0.35], "spacing": 1.0},
    "camera": {"preset": "imp"},
    "views": {"count": 1},
    "image": {"colour": True, "tone": "gamma", "gamma": 1.3, "blur_px": [0.2, 0.5]},
    "light": {"elevation_deg": [30, 60], "ambient": [0.5, 0.65]},
    "sensor": {"full_well_e": 2e4, "jpeg_quality": 90},
    "renderer": "embree",
}
_FARTHEST_M = 5.0


def site_pictures(numbers: range) -> Iterator[Bytes]:
    """Yield colour pictures of the rough sites in turn, from distances of 3 to 5 m."""
    rough = [site for site in SITES if site != "plain"]
    for seed in numbers:
        distance_m = _FARTHEST_M - 0.5 * (seed % 5)
        camera = {
            **SITE["camera"],
            "distance_m": distance_m,
            "elevation_deg": 20.0 + 5.0 * (seed % 4),
        }
        said = {**SITE, "site": rough[seed % len(rough)], "camera": camera, "seed": seed}
        yield scene_picture(convert_spec(with_site(said, where="site"), where="site"))


def scene_picture(spec: SceneSpec) -> Bytes:
    """Picture (rows, cols, 3) of a scene's first view, as its camera takes and develops it."""
    scene = build_scene(spec, 0)
    stage = spec_stage(spec, 0, scene)
    renderer = open_renderer("embree", stage, scene.camera)
    pose: Pose = scene.poses[0]
    view = render_view(renderer, stage, scene.camera, pose, supersample=spec.camera.supersample)
    rng = np.random.default_rng(spec.seed)
    development = draw_development(spec, scene=0, view=0)
    light = view.light if view.colour is None else view.colour
    picture = eight_bits(take_picture(light, spec.sensor, rng=rng, development=development))
    return picture if view.colour is not None else np.repeat(picture[..., None], 3, axis=-1)
