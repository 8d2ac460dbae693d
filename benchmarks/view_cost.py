"""What a view costs beside the bare renderer and the writing of its files, and a scene by stage.

Run `python benchmarks/view_cost.py`: each backend of this machine in a process of its own. The
bare renderer is the backend's pass for depth and labels and the painter's picture; passes for the
whole silhouettes of rocks that hide one another, the sensor and the tables are the view's own.
"""

import argparse
import subprocess
import sys
import time
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from synth import dataset
from synth.light.painter import Painter
from synth.render.choice import BACKENDS, has_backend
from synth.spec import RendererName, SceneSpec
from synth.spec.rocks import RocksSpec
from synth.spec.view import CameraSpec, ViewsSpec

_STAGES = (
    "build_scene",
    "light_scene",
    "open_renderer",
    "render_view",
    "capture_view",
    "_write_tables",
    "scene_glb",
    "write_ply_mm",
    "write_png",
)
_LIMIT = 1.5


def main() -> None:
    """Print the table of every backend, or of one."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--backend", choices=BACKENDS)
    parser.add_argument("--views", type=int, default=9)
    parser.add_argument("--scenes", type=int, default=3)
    args = parser.parse_args()
    if args.backend is not None:
        measure(args.backend, views=args.views, scenes=args.scenes)
        return
    print("backend  view ms  bare ms  writing ms  (view - writing) / bare, limit 1.5")
    for backend in filter(has_backend, BACKENDS):
        options = ["--views", str(args.views), "--scenes", str(args.scenes)]
        subprocess.run([sys.executable, __file__, "--backend", backend, *options], check=True)


def measure(backend: RendererName, *, views: int, scenes: int) -> None:
    """Print one backend's further view, then a new scene of one view by stage."""
    seconds = _watch()
    _run(backend, views=1, seed=100)  # warms up
    few, many, spent = 0.0, 0.0, defaultdict(float)
    stages: dict[str, float] = defaultdict(float)
    for seed in range(scenes):
        seconds.clear()
        few += _run(backend, views=1, seed=seed)
        first = dict(seconds)
        seconds.clear()
        many += _run(backend, views=views, seed=seed)
        for name, value in seconds.items():
            spent[name] += value - first.get(name, 0.0)
        for name, value in first.items():
            stages[name] += value
    further = scenes * (views - 1) / 1000.0
    view_ms, bare_ms = (many - few) / further, (spent["measure"] + spent["paint"]) / further
    write_ms = spent["write_png"] / further
    ratio = (view_ms - write_ms) / bare_ms
    print(f"{backend:7} {view_ms:8.1f} {bare_ms:8.1f} {write_ms:11.1f}  {ratio:.2f}")
    parts = ", ".join(f"{name.strip('_')} {1000 * stages[name] / scenes:.0f}" for name in _STAGES)
    print(f"        a new scene of one view, {1000 * few / scenes:.0f} ms: {parts}")


def _run(backend: RendererName, *, views: int, seed: int) -> float:
    """Return the seconds that one scene takes."""
    spec = SceneSpec(
        seed=seed,
        rocks=RocksSpec(count=6),
        camera=CameraSpec(preset="msl-navcam"),
        views=ViewsSpec(count=views),
    )
    with TemporaryDirectory() as folder:
        start = time.perf_counter()
        dataset.write_scene(spec, 0, backend, Path(folder))
        return time.perf_counter() - start


def _watch() -> dict[str, float]:
    """Time the stages of `write_scene` and the renderer's two plain passes; return the seconds."""
    seconds: dict[str, float] = defaultdict(float)

    def timed(name: str, call: Callable[..., Any]) -> Callable[..., Any]:
        def wrapper(*args: Any, **options: Any) -> Any:
            start = time.perf_counter()
            result = call(*args, **options)
            plain = name != "measure" or args[2] is None
            seconds[name if plain else "silhouettes"] += time.perf_counter() - start
            return result

        return wrapper

    for name in _STAGES:
        setattr(dataset, name, timed(name, getattr(dataset, name)))
    Painter.paint = timed("paint", Painter.paint)  # type: ignore[method-assign]
    opened = dataset.open_renderer

    def open_timed(*args: Any) -> Any:
        renderer = opened(*args)
        renderer.measure = timed("measure", renderer.measure)
        return renderer

    dataset.open_renderer = open_timed
    return seconds


if __name__ == "__main__":
    main()
