"""Agreement of the rendering backends."""

from itertools import combinations
from typing import Any

import numpy as np
from case import Case, Column, Table
from timing import in_fresh_process

from synth.dataset.depth import depth_scale_mm, encode_depth
from synth.light import light_scene
from synth.render import open_renderer, render_view
from synth.render.backends import BACKENDS, has_backend
from synth.scene.scene import build_scene
from synth.spec import convert_spec

SCENES: tuple[dict[str, Any], ...] = (
    {},
    {"rocks": {"family": "mixed", "series": "random", "count": 9}},
    {"camera": {"preset": "imp"}},
    {"camera": {"preset": "mer-hazcam"}, "sun": {"elevation_deg": 20}},
    {"camera": {"elevation_deg": 12}, "sun": {"elevation_deg": 15, "azimuth_deg": 300}},
    {"ground": {"slope_deg": 8, "burial": [0.1, 0.4], "resting": "stable"}},
    {"ground": {"ripple_height_m": 0.02, "ripple_length_m": 0.4}},
    {"ground": {"pebbles_per_m2": 60}, "surface": {"dust": 0.6}},
    {"population": {"kind": "golombek-rapp", "k": 0.06, "d_min_m": 0.12}},
    {"surface": {"law": "lunar-lambert"}, "camera": {"roll_deg": 10}},
)


def _backends() -> list[str]:
    """Return the backends that this machine has."""
    return [backend for backend in BACKENDS if has_backend(backend)]


def agreement(*, scenes: tuple[int, ...] = tuple(range(len(SCENES)))) -> list[Table]:
    """Compare the first view of each scene by every pair of backends.

    Depth is compared where both depth images store it: ground beyond their 65,535 steps, where a
    depth buffer of 24 bits cannot tell millimetres, is no part of a dataset.
    """
    present = _backends()
    found: dict[tuple[str, str], list[tuple[float, ...]]] = {}
    for number in scenes:
        views = {backend: in_fresh_process(_first_view, number, backend) for backend in present}
        for pair in combinations(present, 2):
            found.setdefault(pair, []).append(_difference(*(views[one] for one in pair)))
    rows = [(" and ".join(pair), *np.max(all_, axis=0)) for pair, all_ in found.items()]
    heads = (
        Column("labels that differ", "px", ".0f"),
        Column("depths over 1 mm apart", "px", ".0f"),
        Column("median depth difference", "µm", ".1f"),
        Column("grey values over 4 apart", "px", ".0f"),
    )
    return [Table((Column("largest of all scenes"), *heads), rows)]


def _first_view(number: int, backend: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return depth as a dataset stores it, labels and image."""
    spec = convert_spec({"seed": 100 + number, **SCENES[number]}, where=f"scene {number}")
    scene = build_scene(spec, 0)
    stage = light_scene(scene, spec.sun, spec.surface)
    renderer = open_renderer(backend, stage, scene.camera)
    view = render_view(renderer, stage, scene.camera, scene.poses[0], supersample=2)
    stored = encode_depth(view.depth_m, depth_scale_mm(spec)) > 0
    return np.where(stored, view.depth_m, np.nan), view.labels, view.image


def _difference(one: tuple[np.ndarray, ...], two: tuple[np.ndarray, ...]) -> tuple[float, ...]:
    apart_m = np.abs(one[0] - two[0])
    apart_m = apart_m[~np.isnan(apart_m)]
    grey = np.abs(one[2].astype(int) - two[2])
    return (
        float((one[1] != two[1]).sum()),
        float((apart_m > 1e-3).sum()),
        1e6 * float(np.median(apart_m)),
        float((grey > 4).sum()),
    )


BACKENDS_CASE = Case(
    name="backends",
    what="agreement of the rendering backends, largest difference over the scenes",
    run=agreement,
    smallest={"scenes": (2,)},
)
