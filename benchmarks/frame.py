"""A frame of 1024×1024 pixels with 40 rocks, from range to table, stage by stage.

Run `python benchmarks/frame.py`; the frame is rendered first. The goal is 0.6 s on two cores; the
paper's Matlab took 2 minutes for the flat and 5 for the solid measures on a workstation of its day.
Each stage's share is its own, without what it calls: the fits that measures share stand by
themselves. Beside wall time the processor's is told, which other work on the machine moves less.
"""

import argparse
import statistics
import time
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rockshape import pipeline
from rockshape.io import read_camera, read_image, read_range
from rockshape.measurement import to_frame
from rockshape.measures import Measure
from rockshape.method import methods
from rockshape.observation import Observation
from rockshape.rock import view as rock_view
from rockshape.segmentation import published, robust
from synth.dataset.write import write_common, write_scene
from synth.render import choose_backend
from synth.spec import SceneSpec
from synth.spec.rocks import RocksSpec
from synth.spec.view import CameraSpec, ViewsSpec

ROCKS = 40
SEED = 10005
GOAL_S = 0.6
STAGES = ("visible_fraction",)
FITS = (
    "trace_outline",
    "edge_of",
    "pixel_smooth",
    "form_outline",
    "feret_diameters",
    "fit_ellipse",
    "moment_ellipse",
    "fit_ellipsoid",
    "view_patch",
    "fit_surface",
    "grazing_rays",
    "fit_held_ellipsoid",
    "measure_relief",
)


def render(folder: Path) -> Observation:
    """A rover's navigation camera over a field of rocks."""
    spec = SceneSpec(
        seed=SEED,
        rocks=RocksSpec(count=ROCKS),
        camera=CameraSpec(preset="mer-navcam"),
        views=ViewsSpec(count=1),
    )
    backend = choose_backend(spec.renderer)
    write_scene(spec, 0, backend, folder)
    write_common(spec, backend, folder)
    camera = read_camera(folder / "camera.json")
    image = read_image(folder / "000000" / "gray" / "000000.png")
    depth = folder / "000000" / "depth" / "000000.png"
    points_m = read_range(depth, shape=image.shape, camera=camera)
    return Observation(image=image, points_m=points_m, camera=camera)


class Stopwatch:
    """Processor seconds by stage, each without the stages that it calls."""

    def __init__(self) -> None:
        """Start with none."""
        self.spent: dict[str, float] = defaultdict(float)
        self._within = [0.0]  # seconds of the stages called so far, at each depth

    def timed(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        """The function, adding up the seconds that it takes."""

        def call(*args: Any, **options: Any) -> Any:
            self._within.append(0.0)
            start = time.process_time()
            try:
                return function(*args, **options)
            finally:
                taken = time.process_time() - start
                self.spent[name] += taken - self._within.pop()
                self._within[-1] += taken

        return call


def watch(clock: Stopwatch) -> None:
    """Have the pipeline's stages, the fits and each measure's reading tell their seconds."""
    for module, names in (
        (robust, ("segment_both",)),
        (published, ("segment_published",)),
        (pipeline, STAGES),
        (rock_view, FITS),
    ):
        for name in names:
            setattr(module, name, clock.timed(name, getattr(module, name)))
    read = Measure.read

    def read_timed(measure: Measure, rock: Any) -> Any:
        return clock.timed(measure.column, read)(measure, rock)

    Measure.read = read_timed  # type: ignore[method-assign]


def run(observation: Observation, method: str, *, rounds: int, clock: Stopwatch) -> None:
    """Print the median times of one method and the stages' shares over all rounds."""
    wall, processor = [], []
    rocks = 0
    for turn in range(rounds + 1):
        if turn == 1:  # the first warms up
            clock.spent.clear()
        start, begun = time.perf_counter(), time.process_time()
        measurement = pipeline.measure(observation, method=method)
        to_frame(measurement)
        wall.append(time.perf_counter() - start)
        processor.append(time.process_time() - begun)
        rocks = len(measurement.rocks)
    seconds = statistics.median(wall[1:])
    print(
        f"\n{method}: {rocks} rocks, {seconds:.3f} s of wall time, "
        f"{statistics.median(processor[1:]):.3f} s of the processor; goal {GOAL_S} s"
    )
    whole = sum(processor[1:])
    rest = whole - sum(clock.spent.values())
    for name, taken in sorted([*clock.spent.items(), ("rest", rest)], key=lambda item: -item[1]):
        print(f"  {name:22s}{taken / rounds:8.3f} s {taken / whole:6.1%}")


def main() -> None:
    """Render the frame and print both methods."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    args = parser.parse_args()
    with TemporaryDirectory() as name:
        observation = render(Path(name) / "scene")
    rows, cols = observation.image.shape
    print(f"{cols}×{rows} pixels, {ROCKS} rocks")
    clock = Stopwatch()
    watch(clock)
    for method in methods():
        run(observation, method, rounds=args.rounds, clock=clock)


if __name__ == "__main__":
    main()
