"""Tiles cut from views of made sites: rocks on rough ground, seen as a lander sees them."""

from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.errors import SpecError
from synth.light.spec_stage import spec_stage
from synth.render import open_renderer, render_view
from synth.scene.scene import build_scene
from synth.sensor.development import draw_development
from synth.sensor.exposure import eight_bits, take_picture
from synth.spec import SceneSpec, convert_spec
from synth.spec.site import with_site
from training.tile import SIDE_PX, Tile, cut_tiles

_SITES = ("pathfinder", "gale", "dunes", "pathfinder", "plain")
_PLAIN = ("plain",)
_VIEWS = 4
_THINGS = ("ruler", "cable", "coin", "ball", "mast-shadow")


def site_tiles(seed: int, tiles: int, smooth: bool) -> list[Tile]:
    """So many tiles of scenes that a seed draws, all on level planes where smooth."""
    made: list[Tile] = []
    scene = 0
    while len(made) < tiles:
        rng = np.random.default_rng([seed, 60, scene])
        spec = _spec(rng, seed * 100 + scene, _PLAIN if smooth else _SITES)
        scene += 1
        try:
            made += _tiles_of(spec, rng)
        except SpecError:  # its rocks find no room: another draw
            continue
    return made[:tiles]


def _spec(rng: np.random.Generator, seed: int, sites: Sequence[str]) -> SceneSpec:
    """Specification of a scene: a population of rocks down to a few centimetres, no outcrop."""
    site = str(rng.choice(sites))
    facets = {"subdivisions": 4}
    distance_m = float(rng.uniform(1.8, 4.5))
    said: dict[str, Any] = {
        "site": site,
        "seed": seed,
        "renderer": "embree",
        "rocks": {"family": "field", "options": facets, "realism": facets, "spacing": 1.0},
        "population": {
            "kind": "golombek-rapp",
            "k": float(rng.uniform(0.04, 0.25)),
            "d_min_m": 0.012 * distance_m,
            "d_max_m": float(rng.uniform(0.1, 0.3)) * distance_m,
            "radius_m": 0.5 * distance_m,
        },
        "camera": {
            "preset": "msl-navcam",
            "distance_m": distance_m,
            "elevation_deg": float(rng.uniform(14.0, 60.0)),
        },
        "views": {"count": _VIEWS, "start_deg": float(rng.uniform(0.0, 360.0))},
        "sun": {
            "azimuth_deg": float(rng.uniform(0.0, 360.0)),
            "elevation_deg": float(rng.uniform(12.0, 70.0)),
            "ambient": float(rng.uniform(0.15, 0.6)),
        },
        "image": {
            "colour": True,
            "tone": str(rng.choice(["gamma", "srgb", "filmic"])),
            "exposure_stops": [-1.2, 0.2],
            "blur_px": [0.2, 1.0],
            "white_balance": 0.1,
        },
        "sensor": {"full_well_e": 2e4, "jpeg_quality": int(rng.integers(60, 98))},
    }
    if site != "plain":
        said["ground"] = {
            "pebbles_per_m2": float(rng.uniform(0.0, 400.0)),
            "pebble_diameter_m": [0.002 * distance_m, 0.007 * distance_m],
            "burial": [0.0, 0.6],
            "terrain": {"outcrop": 0.0},
        }
    if rng.uniform() < 0.35:
        said["things"] = {"kinds": [str(one) for one in rng.choice(_THINGS, 2, replace=False)]}
    return convert_spec(with_site(said, where="sites"), where="sites")


def _tiles_of(spec: SceneSpec, rng: np.random.Generator) -> list[Tile]:
    scene = build_scene(spec, 0)
    stage = spec_stage(spec, 0, scene)
    renderer = open_renderer("embree", stage, scene.camera)
    tiles: list[Tile] = []
    for number, pose in enumerate(scene.poses):
        view = render_view(renderer, stage, scene.camera, pose, supersample=2)
        development = draw_development(spec, scene=0, view=number)
        light = view.light if view.colour is None else view.colour
        picture = eight_bits(take_picture(light, spec.sensor, rng=rng, development=development))
        tiles += cut_tiles(*_at_least_a_tile(picture, view.labels))
    return tiles


def _at_least_a_tile(
    picture: NDArray[np.uint8], labels: NDArray[np.uint16]
) -> tuple[NDArray[np.uint8], NDArray[np.uint16]]:
    """Picture and labels enlarged to a tile's side where they are smaller."""
    scale = SIDE_PX / min(labels.shape)
    if scale <= 1.0:
        return picture, labels
    size = tuple(int(np.ceil(scale * side)) for side in labels.shape[::-1])
    return (
        np.asarray(cv2.resize(picture, size, interpolation=cv2.INTER_CUBIC), dtype=np.uint8),
        np.asarray(cv2.resize(labels, size, interpolation=cv2.INTER_NEAREST), dtype=np.uint16),
    )
