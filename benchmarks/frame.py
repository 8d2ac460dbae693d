"""A frame of 1024×1024 pixels with 40 rocks, from range to table, stage by stage.

Run `python benchmarks/frame.py`; the frame is rendered first. The goal is 0.6 s on two cores; the
paper's Matlab took 2 minutes for the flat and 5 for the solid measures on a workstation of its day.
A measure's share includes the fit that it is the first to ask for.
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
from rockshape.measures import METHODS, Measure
from rockshape.observation import Observation
from rockshape.table import to_frame
from synth.dataset import write_common, write_scene
from synth.render import choose_backend
from synth.spec import SceneSpec
from synth.spec.rocks import RocksSpec
from synth.spec.view import CameraSpec, ViewsSpec

ROCKS = 40
SEED = 10005
GOAL_S = 0.6
STAGES = ("segment", "estimate_range_noise", "_patches", "visible_fraction")


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


def timed(spent: dict[str, float], name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """The function, adding up the seconds that it takes."""

    def call(*args: Any, **options: Any) -> Any:
        start = time.perf_counter()
        try:
            return function(*args, **options)
        finally:
            spent[name] += time.perf_counter() - start

    return call


def watch(spent: dict[str, float]) -> None:
    """Have the pipeline's stages, and each measure's reading, add up their seconds."""
    for name in STAGES:
        setattr(pipeline, name, timed(spent, name.strip("_"), getattr(pipeline, name)))
    read = Measure.read

    def read_timed(measure: Measure, rock: Any) -> Any:
        return timed(spent, measure.column, read)(measure, rock)

    Measure.read = read_timed  # type: ignore[method-assign]


def run(observation: Observation, method: str, *, rounds: int, spent: dict[str, float]) -> None:
    """Print the median time of one method and the stages' shares in the last round."""
    whole = []
    rocks = 0
    for _ in range(rounds + 1):
        spent.clear()
        start = time.perf_counter()
        measurement = pipeline.measure(observation, method=method)
        to_frame(measurement)
        whole.append(time.perf_counter() - start)
        rocks = len(measurement.rocks)
    median = statistics.median(whole[1:])  # the first warms up
    print(f"\n{method}: {rocks} rocks, {median:.3f} s, {GOAL_S / median:.2f} of the goal's speed")
    rest = whole[-1] - sum(spent.values())
    for name, seconds in sorted([*spent.items(), ("rest", rest)], key=lambda item: -item[1]):
        print(f"  {name:22s}{seconds:8.3f} s {seconds / whole[-1]:6.1%}")


def main() -> None:
    """Render the frame and print both methods."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    args = parser.parse_args()
    with TemporaryDirectory() as name:
        observation = render(Path(name) / "scene")
    rows, cols = observation.image.shape
    print(f"{cols}×{rows} pixels, {ROCKS} rocks")
    spent: dict[str, float] = defaultdict(float)
    watch(spent)
    for method in METHODS:
        run(observation, method, rounds=args.rounds, spent=spent)


if __name__ == "__main__":
    main()
