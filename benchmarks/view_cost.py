"""What a view costs beside the bare renderer and the writing of its files, and a scene by stage.

    python benchmarks/view_cost.py [--backend osmesa] [--views 9] [--scenes 3]

Each backend of this machine in a process of its own, which has one thread; the times are the
processor's, so that other work on the machine does not count. A view without the writing of its
files is held to three floors of the same run: the bare renderer that makes as much (`bare.py`); the
geometry of that alone, without any light; and the view's own passes, the backend's for depth and
labels and the painter's, over which come the silhouettes of rocks that hide one another, sensor
and tables.
"""

import argparse
import os
import subprocess
import sys
import time
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from bare import BareRenderer
from numpy.typing import NDArray

from synth.dataset import write as dataset
from synth.dataset.workers import ONE_THREAD
from synth.light import light_scene
from synth.light.painter import Painter
from synth.render.backends import BACKENDS, has_backend
from synth.scene.scene import build_scene
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
_PASSES = ("measure", "paint")
_HEADER = """\
ms        view   writing      bare  ratio  geometry  ratio    passes  ratio
(ratio: view without writing over the column before it; limit 1.5 for bare)"""


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
    print(_HEADER)
    for backend in filter(has_backend, BACKENDS):
        options = ["--views", str(args.views), "--scenes", str(args.scenes)]
        command = [sys.executable, __file__, "--backend", backend, *options]
        subprocess.run(command, check=True, env={**os.environ, **ONE_THREAD})


def measure(backend: RendererName, *, views: int, scenes: int) -> None:
    """Print one backend's further view, then a new scene of one view by stage."""
    seconds = _watch()
    _run(backend, views=1, seed=100)  # warms up
    few, many, bare, spent = 0.0, 0.0, np.zeros(2), defaultdict(float)
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
        bare += _bare(backend, views=views, seed=seed)
    further = scenes * (views - 1) / 1000.0
    view_ms, write_ms = (many - few) / further, spent["write_png"] / further
    own_ms = view_ms - write_ms
    passes_ms = (spent["measure"] + spent["paint"]) / further
    print(f"{backend:7} {view_ms:6.0f} {write_ms:9.0f}", end="")
    for floor_ms in (*(bare / further), passes_ms):
        print(f" {floor_ms:9.0f} {own_ms / floor_ms:6.2f}", end="")
    print()
    names = [*_PASSES, "silhouettes", "capture_view"]
    rest = own_ms - sum(spent[name] for name in names) / further
    parts = ", ".join(f"{name.strip('_')} {spent[name] / further:.0f}" for name in names)
    print(f"        of it: {parts}, tables and the rest {rest:.0f}")
    parts = ", ".join(f"{name.strip('_')} {1000 * stages[name] / scenes:.0f}" for name in _STAGES)
    print(f"        a new scene of one view, {1000 * few / scenes:.0f} ms: {parts}", flush=True)


def _bare(backend: RendererName, *, views: int, seed: int) -> NDArray[np.float64]:
    """Return the bare renderer's seconds for all views but the first: all of it, geometry alone."""
    spec = _spec(views, seed)
    scene = build_scene(spec, 0)
    stage = light_scene(scene, spec.sun, spec.surface)
    bare = BareRenderer(backend, stage, scene.camera, spec.camera.supersample)
    bare.seconds(scene.poses[0])  # warms up
    return np.sum([bare.seconds(pose) for pose in scene.poses[1:]], axis=0)


def _run(backend: RendererName, *, views: int, seed: int) -> float:
    """Return the seconds that one scene takes."""
    spec = _spec(views, seed)
    with TemporaryDirectory() as folder:
        start = time.process_time()
        dataset.write_scene(spec, 0, backend, Path(folder))
        return time.process_time() - start


def _spec(views: int, seed: int) -> SceneSpec:
    return SceneSpec(
        seed=seed,
        rocks=RocksSpec(count=6),
        camera=CameraSpec(preset="msl-navcam"),
        views=ViewsSpec(count=views),
    )


def _watch() -> dict[str, float]:
    """Time the stages of `write_scene` and the renderer's two plain passes; return the seconds."""
    seconds: dict[str, float] = defaultdict(float)

    def timed(name: str, call: Callable[..., Any]) -> Callable[..., Any]:
        def wrapper(*args: Any, **options: Any) -> Any:
            start = time.process_time()
            result = call(*args, **options)
            plain = name != "measure" or args[2] is None
            seconds[name if plain else "silhouettes"] += time.process_time() - start
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
