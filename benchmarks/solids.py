"""The 3-D measures against truth: the paper's readings beside the robust ones.

Run `python benchmarks/solids.py --distance 4.5`. Rocks with their true labels, so that nothing but
the measures is judged; exact range, and the msl-navcam's stereo model with σ_d = 0.32 px. tau is
Kendall's: `form` over all rocks against the maximum projection sphericity of the box; `graded` and
`relief` the mean over views of the order within each, against falling roundness and rising relief.
"""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass

import msgspec
import numpy as np
from numpy.typing import NDArray
from scipy.stats import kendalltau

from rockshape.camera.camera import Camera
from rockshape.ground import fit_ground
from rockshape.measures import angularity_3d, ellipsoid_error, sphericity_3d
from rockshape.rock.view import RockView
from synth.light import light_scene
from synth.render import choose_backend, open_renderer, render_view
from synth.rocks.truth import maximum_projection_sphericity
from synth.scene.scene import SceneModel, build_scene
from synth.sensor import capture_view
from synth.spec import SceneSpec
from synth.spec.rocks import RocksSpec
from synth.spec.sensor import NoiseSpec
from synth.spec.view import CameraSpec, ViewsSpec

Floats = NDArray[np.float64]

SERIES = {
    "form": (
        8,
        RocksSpec(count=6, series="random", b_over_a=(0.5, 1.0), c_over_b=(0.4, 1.0)),
    ),
    "graded": (6, RocksSpec(count=6)),
    "relief": (
        4,
        RocksSpec(
            count=6,
            series="relief",
            relief_rms=(0.002, 0.03),
            relief_degrees=(8, 20),
            rounding=(0.3, 0.3),
        ),
    ),
}
MEASURES = {
    "paper": (ellipsoid_error.PAPER, sphericity_3d.PAPER, angularity_3d.PAPER),
    "robust": (ellipsoid_error.ROBUST, sphericity_3d.ROBUST, angularity_3d.ROBUST),
}


@dataclass(frozen=True, eq=False)
class Row:
    """One rock in one view by one method."""

    view: tuple[int, int]
    true_axes: Floats
    knob: float  # what the ranking measures should follow; NaN in `form`
    values: Floats  # (3,), ellipsoid error, sphericity, angularity
    axes: Floats  # (3,), NaN where there is no ellipsoid


def rock_views(
    depth_m: Floats, labels: NDArray[np.integer], camera: Camera
) -> Iterator[tuple[int, RockView]]:
    """The rocks of a frame with their true pixels, by instance."""
    points_m = camera.unproject(depth_m)
    ground = fit_ground(points_m, pixel_rad=1 / camera.fx)
    for number in np.unique(labels[labels != 0]):
        rows, cols = np.nonzero(labels == number)
        window = np.s_[rows.min() : rows.max() + 1, cols.min() : cols.max() + 1]
        yield (
            int(number) - 1,
            RockView(
                mask=labels[window] == number,
                corner=(int(rows.min()), int(cols.min())),
                grid_m=points_m[window],
                camera=camera,
                ground=ground,
            ),
        )


def measured(view: RockView, method: str) -> tuple[Floats, Floats]:
    """The three values, and the half-axes that they rest on."""
    values = np.array([measure.read(view).value for measure in MEASURES[method]])
    if method == "paper":
        body = None if view.ellipsoid is None else view.ellipsoid.ellipsoid
    else:
        body = view.held_ellipsoid
    return values, np.full(3, np.nan) if body is None else body.half_axes_m


def knob_of(scene: SceneModel, instance: int, series: str) -> float:
    """What is turned in a series, rising with angularity."""
    truth = scene.rocks[instance].rock.truth
    if series == "graded":
        return float("nan") if truth.roundness is None else 1 - truth.roundness
    if series == "relief":
        return float("nan") if truth.relief_rms_m is None else truth.relief_rms_m
    return float("nan")


def run(
    series: str, distance_m: float, *, seed: int, scenes: int
) -> dict[tuple[str, str], list[Row]]:
    """Measure a series at a distance, with exact range and with stereo noise."""
    spec = SceneSpec(
        seed=seed,
        renderer="embree",
        rocks=SERIES[series][1],
        camera=CameraSpec(distance_m=distance_m, supersample=1),
        views=ViewsSpec(count=2),
    )
    backend = choose_backend(spec.renderer)
    found: dict[tuple[str, str], list[Row]] = {}
    for index in range(scenes):
        scene = build_scene(spec, index)
        stage = light_scene(scene, spec.sun, spec.surface)
        renderer = open_renderer(backend, stage, scene.camera)
        eye = scene.camera
        camera = Camera(eye.fx, eye.fy, eye.cx, eye.cy, eye.width, eye.height)
        for number, pose in enumerate(scene.poses):
            view = render_view(renderer, stage, scene.camera, pose, supersample=1)
            for kind in ("none", "stereo"):
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
                for instance, rock in rock_views(capture.depth_m, view.labels, camera):
                    for method in MEASURES:
                        values, axes = measured(rock, method)
                        row = Row(
                            view=(index, number),
                            true_axes=scene.rocks[instance].rock.truth.half_axes_box_m,
                            knob=knob_of(scene, instance, series),
                            values=values,
                            axes=axes,
                        )
                        found.setdefault((kind, method), []).append(row)
    return found


def tau_in_views(rows: list[Row], column: int) -> float:
    """Mean over views of Kendall's tau between a measure and the knob."""
    taus = []
    for view in sorted({row.view for row in rows}):
        pairs = [
            (row.values[column], row.knob)
            for row in rows
            if row.view == view and np.isfinite(row.values[column])
        ]
        if len(pairs) >= 3:
            taus.append(kendalltau(*np.array(pairs).T).statistic)
    return float(np.mean(taus)) if taus else float("nan")


def line(rows: list[Row], series: str) -> str:
    """The cells of one row of the table."""
    values = np.array([row.values for row in rows])
    axes = np.array([row.axes / row.true_axes for row in rows])
    known = np.isfinite(values[:, 1])
    true = np.array([maximum_projection_sphericity(row.true_axes) for row in rows])
    error = np.abs(values[known, 1] - true[known]).mean()
    slips = " / ".join(f"{100 * slip:.0f}" for slip in np.abs(axes[known] - 1).mean(axis=0))
    cells = [f"{known.sum()}/{len(rows)}", f"{error:.3f}"]
    if series == "form":
        cells += [f"{kendalltau(values[known, 1], true[known]).statistic:.2f}", slips, "", ""]
    else:
        cells += ["", slips]
        for column in (0, 2):
            share = np.isfinite(values[:, column]).mean()
            cells.append(f"{tau_in_views(rows, column):.2f} ({100 * share:.0f} %)")
    return " | ".join(cells)


def main() -> None:
    """Print the table in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--distance", type=float, default=4.5, help="m, camera to scene's centre")
    parser.add_argument("--series", choices=[*SERIES, "all"], default="all")
    parser.add_argument("--seed", type=int, default=10000)
    parser.add_argument("--share", type=float, default=1.0, help="of the scenes")
    arguments = parser.parse_args()
    print("| series | m | range | method | ellipsoids | sphericity MAE | sphericity tau", end="")
    print(" | a/b/c error % | ellipsoid error tau (measured) | angularity tau (measured) |")
    print("| --- " * 10 + "|")
    for series in SERIES if arguments.series == "all" else (arguments.series,):
        scenes = max(1, round(arguments.share * SERIES[series][0]))
        found = run(series, arguments.distance, seed=arguments.seed, scenes=scenes)
        for (kind, method), rows in found.items():
            shown = "exact" if kind == "none" else kind
            head = f"| {series} | {arguments.distance:g} | {shown} | {method} | "
            print(head + line(rows, series) + " |", flush=True)


if __name__ == "__main__":
    main()
