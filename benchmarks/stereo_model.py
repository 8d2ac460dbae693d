"""The stereo error model against a real matcher on the same scenes, by range.

Run `python benchmarks/stereo_model.py --plot docs/images/stereo_model.png`. Both measure the same
views; errors are compared where both found a depth, and matches wrong by more than 3 px, which no
normal error is, are left out and counted. Ranges where σ_Z is over a twentieth of Z are left out:
there σ_Z = Z² σ_d/(f B), a first order, is no law. σ_d = 0.32 px is a rover's (Kim et al. 2005),
whose pictures came down strongly compressed; the default pictures here are so too.
"""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import matplotlib as mpl
import msgspec
import numpy as np
from numpy.typing import NDArray

from synth.light import light_scene
from synth.render import choose_backend, open_renderer, render_view
from synth.scene import build_scene
from synth.sensor import capture_view
from synth.sensor.rig import Rig, rig_of
from synth.spec import SceneSpec
from synth.spec.sensor import NoiseSpec, SensorSpec
from synth.spec.view import CameraSpec, ViewsSpec

mpl.use("Agg")
from matplotlib import pyplot as plt

Floats = NDArray[np.float64]

_PRESETS = ("mer-hazcam", "mer-navcam", "msl-navcam", "imp")
_FLIGHT = SensorSpec(full_well_e=20000.0, read_noise_e=25.0)
_FIRST_ORDER = 0.05  # the most that σ_Z over Z may be
_GROSS_PX = 3.0
_BINS = 6  # of range for each preset
_LEAST_PIXELS = 2000
_FACTOR = 1.5


@dataclass(frozen=True)
class Row:
    """Errors in one range of one preset."""

    preset: str
    range_m: float
    pixels: int
    formula_m: float
    model_m: float
    matcher_m: float


@dataclass(frozen=True, eq=False)
class Errors:
    """Depths of all views of a preset, pixels in one long row."""

    true_m: Floats
    model_m: Floats
    matcher_m: Floats


def main() -> None:
    """Print the table and the holes; draw the plot."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--plot", type=Path)
    parser.add_argument("--scenes", type=int, default=1)
    parser.add_argument("--clean", action="store_true", help="pictures without noise or JPEG")
    parser.add_argument("--jpeg-quality", type=int, default=50)
    args = parser.parse_args()
    noisy = msgspec.structs.replace(_FLIGHT, jpeg_quality=args.jpeg_quality)
    sensor = SensorSpec() if args.clean else noisy
    rows: list[Row] = []
    print("preset       range m   pixels  formula cm  model cm  matcher cm  model/matcher")
    for preset in _PRESETS:
        errors = _measured(preset, sensor, scenes=args.scenes)
        rig = rig_of(preset)
        found = list(_by_range(preset, rig, errors))
        for row in found:
            print(
                f"{row.preset:11} {row.range_m:8.2f} {row.pixels:8d} {100 * row.formula_m:11.3f} "
                f"{100 * row.model_m:9.3f} {100 * row.matcher_m:11.3f} "
                f"{row.model_m / row.matcher_m:14.2f}"
            )
        print(f"            {_holes(rig, errors)}")
        rows += found
    ratios = np.array([row.model_m / row.matcher_m for row in rows])
    inside = ((ratios < _FACTOR) & (ratios > 1.0 / _FACTOR)).mean()
    print(
        f"model/matcher: {ratios.min():.2f} to {ratios.max():.2f}, "
        f"{100 * inside:.0f} % of {len(rows)} ranges within a factor of {_FACTOR}"
    )
    if args.plot is not None:
        _draw(rows, args.plot)


def _measured(preset: str, sensor: SensorSpec, *, scenes: int) -> Errors:
    """Return what both measure in some views of a preset."""
    spec = SceneSpec(
        seed=5,
        renderer="auto",
        camera=CameraSpec(preset=preset),  # type: ignore[arg-type]
        views=ViewsSpec(count=2),
        sensor=sensor,
    )
    backend = choose_backend(spec.renderer)
    depths: dict[str, list[Floats]] = {"true": [], "stereo": [], "sgm": []}
    for index in range(scenes):
        scene = build_scene(spec, index)
        stage = light_scene(scene, spec.sun, spec.surface)
        renderer = open_renderer(backend, stage, scene.camera)
        for number, pose in enumerate(scene.poses):
            view = render_view(renderer, stage, scene.camera, pose, supersample=2)
            depths["true"].append(view.depth_m.ravel())
            for kind in ("stereo", "sgm"):
                capture = capture_view(
                    view,
                    pose,
                    spec=msgspec.structs.replace(spec, noise=NoiseSpec(kind=kind)),
                    scene=index,
                    number=number,
                    camera=scene.camera,
                    stage=stage,
                    renderer=renderer,
                )
                depths[kind].append(capture.depth_m.ravel())
    return Errors(*(np.concatenate(parts) for parts in depths.values()))


def _gross(rig: Rig, errors: Errors) -> NDArray[np.bool_]:
    slip_px = rig.disparity_px(errors.matcher_m) - rig.disparity_px(errors.true_m)
    return np.asarray(np.abs(slip_px) > _GROSS_PX)


def _by_range(preset: str, rig: Rig, errors: Errors) -> Iterator[Row]:
    known = ~np.isnan(errors.true_m + errors.model_m + errors.matcher_m) & ~_gross(rig, errors)
    true_m = errors.true_m[known]
    edges_m = np.geomspace(*np.percentile(true_m, [0.5, 99.5]), _BINS + 1)
    for low_m, high_m in pairwise(edges_m):
        here = np.flatnonzero(known)[(true_m >= low_m) & (true_m < high_m)]
        exact_m = errors.true_m[here]
        formula_m = _rms(rig.depth_sd_m(exact_m, NoiseSpec().disparity_px))
        if len(here) < _LEAST_PIXELS or formula_m > _FIRST_ORDER * exact_m.mean():
            continue
        yield Row(
            preset=preset,
            range_m=float(exact_m.mean()),
            pixels=len(here),
            formula_m=formula_m,
            model_m=_rms(errors.model_m[here] - exact_m),
            matcher_m=_rms(errors.matcher_m[here] - exact_m),
        )


def _holes(rig: Rig, errors: Errors) -> str:
    """Return a line on where each found nothing, of the pixels that have a true depth."""
    there = ~np.isnan(errors.true_m)
    gross = 100.0 * _gross(rig, errors)[there].mean()
    model, matcher = np.isnan(errors.model_m[there]), np.isnan(errors.matcher_m[there])
    return (
        f"holes: model {100 * model.mean():.1f} %, matcher {100 * matcher.mean():.1f} %, "
        f"both {100 * (model & matcher).mean():.1f} %; "
        f"off by more than {_GROSS_PX:g} px: matcher {gross:.2f} %"
    )


def _rms(values: Floats) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _draw(rows: list[Row], path: Path) -> None:
    figure, axes = plt.subplots(figsize=(7.0, 4.6), layout="constrained")
    for number, preset in enumerate(_PRESETS):
        mine = [row for row in rows if row.preset == preset]
        range_m = np.array([row.range_m for row in mine])
        model_cm = 100.0 * np.array([row.model_m for row in mine])
        matcher_cm = 100.0 * np.array([row.matcher_m for row in mine])
        colour = f"C{number}"
        axes.fill_between(
            range_m, model_cm / _FACTOR, model_cm * _FACTOR, color=colour, alpha=0.15, lw=0
        )
        axes.plot(range_m, model_cm, "-", color=colour, label=f"{preset}: model")
        axes.plot(range_m, matcher_cm, "o", color=colour, label=f"{preset}: matcher")
    axes.set(xscale="log", yscale="log", xlabel="z-depth, m", ylabel="RMS error of depth, cm")
    axes.set_title(f"Stereo error: the model (band: a factor of {_FACTOR}) and SGBM")
    axes.grid(visible=True, which="both", alpha=0.25)
    axes.legend(ncols=2, fontsize="small")
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    main()
