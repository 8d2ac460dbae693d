"""Range noise estimated from one frame, against the error of each pixel of rendered scenes.

Stereo range is modelled over exact range; truth is its root mean square error over the ground, the
rounding of disparity included. Estimators were chosen on seeds below 1000.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from case import Case, Cell, Column, Table
from noise_estimators import ESTIMATORS
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.ground import fit_ground
from synth.light import light_scene
from synth.render import choose_backend, open_renderer, render_view
from synth.scene.scene import build_scene
from synth.sensor.rig import Rig, rig_of
from synth.sensor.stereo import modelled_depth_m
from synth.spec import convert_spec
from synth.spec.sensor import NoiseSpec

SEED = 10_000
LEVELS_PX = (0.05, 0.1, 0.2, 0.4, 0.8)
ROCKS = {"family": "mixed", "series": "random", "b_over_a": [0.6, 0.95], "c_over_b": [0.5, 0.9]}
FIELD = {"kind": "golombek-rapp", "k": 0.06, "d_min_m": 0.12, "d_max_m": 0.7, "radius_m": 3.2}
CAMERAS: dict[str, dict[str, Any]] = {
    "msl-navcam": {"distance_m": 5.0, "elevation_deg": 24.0},
    "imp": {"distance_m": 3.2, "elevation_deg": 26.0},
}
GROUNDS: dict[str, dict[str, Any]] = {
    "flat": {},
    "sloped, 14°": {"ground": {"slope_deg": 14.0, "slope_azimuth_deg": 60.0}},
    "rippled, 5 cm": {"ground": {"ripple_height_m": 0.05, "ripple_length_m": 0.6}},
    "crowded, k = 0.3": {"population": {**FIELD, "k": 0.3}},
    "pebbled, 800/m²": {"ground": {"pebbles_per_m2": 800.0}},
}


@dataclass(frozen=True, eq=False)
class Exact:
    """A rendered view: exact range, light, and which pixels are rocks; all (rows, cols)."""

    depth_m: NDArray[np.float64]
    light: NDArray[np.floating]
    rocks: NDArray[np.bool_]
    camera: Camera
    rig: Rig

    def measured_m(self, disparity_px: float, *, seed: int) -> NDArray[np.float64]:
        """Z-depth with stereo noise of a disparity; exact for 0."""
        if disparity_px == 0:
            return self.depth_m
        noise = NoiseSpec(kind="stereo", disparity_px=disparity_px)
        rng = np.random.default_rng(seed)
        return modelled_depth_m(self.depth_m, self.light, self.rig, noise, rng=rng)


def exact_view(preset: str, ground: str, seed: int) -> Exact:
    """Render one view of a field of rocks on a ground."""
    table = {
        "seed": seed,
        "rocks": ROCKS,
        "population": FIELD,
        "camera": {"preset": preset, **CAMERAS[preset]},
        "views": {"count": 1, "start_deg": float(37 * seed % 360)},
    }
    spec = convert_spec(table | GROUNDS[ground], where="range_noise")
    scene = build_scene(spec, 0)
    stage = light_scene(scene, spec.sun, spec.surface)
    renderer = open_renderer(choose_backend(spec.renderer), stage, scene.camera)
    view = render_view(renderer, stage, scene.camera, scene.poses[0], supersample=2)
    lens = scene.camera
    camera = Camera(lens.fx, lens.fy, lens.cx, lens.cy, width=lens.width, height=lens.height)
    return Exact(view.depth_m, view.light, view.labels > 0, camera, rig_of(preset))


def estimates(exact: Exact, level_px: float, *, seed: int) -> Iterator[tuple[str, float]]:
    """Yield each estimator's standard deviation over the true one; in pixels for exact range."""
    depth_m = exact.measured_m(level_px, seed=seed)
    points_m = exact.camera.unproject(depth_m)
    found = fit_ground(points_m, pixel_rad=1 / exact.camera.fx)
    if found is None:
        raise RuntimeError("range_noise: expected a scene with ground, found none")
    px_per_m = exact.rig.focal_px * exact.rig.baseline_m
    error = (1 / depth_m - 1 / exact.depth_m)[~exact.rocks]
    true_px = px_per_m * float(np.sqrt(np.nanmean(error**2)))
    for name, estimate in ESTIMATORS.items():
        yield name, px_per_m * estimate(points_m, found, exact.rocks) / (true_px or 1.0)


def accuracy(
    *,
    presets: tuple[str, ...] = tuple(CAMERAS),
    grounds: tuple[str, ...] = tuple(GROUNDS),
    levels_px: tuple[float, ...] = LEVELS_PX,
    scenes: int = 2,
) -> list[Table]:
    """Compare estimators by ground and by level of noise."""
    ratios: dict[tuple[str, str, float], list[float]] = {}
    for preset in presets:
        for ground in grounds:
            for seed in range(SEED, SEED + scenes):
                exact = exact_view(preset, ground, seed)
                for level in (0.0, *levels_px):
                    for name, ratio in estimates(exact, level, seed=seed):
                        ratios.setdefault((name, ground, level), []).append(ratio)
    worst: list[tuple[Cell, ...]] = [
        (
            ground,
            *(
                100 * max(abs(r - 1) for level in levels_px for r in ratios[name, ground, level])
                for name in ESTIMATORS
            ),
            *(max(ratios[name, ground, 0.0]) for name in ESTIMATORS),
        )
        for ground in grounds
    ]
    each = [
        (name, ground, level, min(own), float(np.mean(own)), max(own))
        for (name, ground, level), own in ratios.items()
        if level > 0
    ]
    return [
        Table(
            (
                Column("ground"),
                *(Column(f"{name}: greatest error", "%", ".0f") for name in ESTIMATORS),
                *(Column(f"{name}: of exact range", "px", ".3f") for name in ESTIMATORS),
            ),
            worst,
        ),
        Table(
            (
                Column("estimator"),
                Column("ground"),
                Column("noise", "px", "g"),
                *(Column(name, "", ".2f") for name in ("least", "mean", "greatest")),
            ),
            each,
            name="ratios",
        ),
    ]


RANGE_NOISE_CASE = Case(
    name="range_noise",
    what="range noise estimated from one frame over the true one, by ground and level of noise",
    run=accuracy,
    smallest={"presets": ("imp",), "grounds": ("flat",), "levels_px": (0.2,), "scenes": 1},
)
