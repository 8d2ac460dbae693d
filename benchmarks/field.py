"""A field of 500 rocks at 1024 × 1024: time by stage and memory, and what a view costs.

    python benchmarks/field.py [--backend embree] [--rocks 500]

The times are the processor's, of one thread, so that other work on the machine does not count. The
same run times the geometry alone, at the pixels and at the supersampled pixels of the whole frame:
what an image with the same anti-aliasing takes without any light. The bare renderer that makes a
lit picture, to which the limit of a view's cost refers, is in `view_cost.py`.
"""

import argparse
import resource
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from synth.dataset import write as dataset
from synth.light import light_scene
from synth.render import choose_backend, open_renderer, render_view
from synth.render.view import depth_limits_m
from synth.scene.population import expected_count
from synth.scene.scene import SceneModel, build_scene
from synth.spec import RendererName, SceneSpec, convert_spec
from synth.spec.population import PopulationSpec


def main() -> None:
    """Print the stages."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--backend", default="auto")
    parser.add_argument("--rocks", type=int, default=500)
    args = parser.parse_args()
    backend = choose_backend(args.backend)
    for title, spec in (("default scene", SceneSpec()), ("field", _field(args.rocks))):
        start = time.process_time()
        scene = build_scene(spec, 0)
        print(f"{title} on {backend}: {len(scene.rocks)} rocks, ", end="")
        print(f"{sum(len(rock.mesh.faces) for rock in scene.rocks)} faces")
        start = _told("  rocks and places", start)
        stage = light_scene(scene, spec.sun, spec.surface)
        start = _told("  stage", start)
        renderer = open_renderer(backend, stage, scene.camera)
        fine = open_renderer(backend, stage, scene.camera.refined(2))
        start = _told("  renderers", start)
        pose = scene.poses[0]
        render_view(renderer, stage, scene.camera, pose, supersample=2)
        start = _told("  first view", start)
        full, geometry = [], []
        for pose in scene.poses[1:]:
            start = time.process_time()
            view = render_view(renderer, stage, scene.camera, pose, supersample=2)
            full.append(time.process_time() - start)
            start = time.process_time()
            limits_m = depth_limits_m(stage, scene.camera, pose)
            renderer.measure(pose, limits_m, None)
            fine.measure(pose, limits_m, None)
            geometry.append(time.process_time() - start)
        whole_s, geometry_s = np.median(full), np.median(geometry)
        print(f"  further view {whole_s:7.2f} s, geometry alone {geometry_s:.2f} s, ", end="")
        seen = len(np.unique(view.labels)) - 1
        print(f"ratio {whole_s / geometry_s:.2f}; {seen} rocks in sight")
        start = time.process_time()
        _write(spec, scene, backend)
        _told(f"  scene of {len(scene.poses)} views", start)
    memory_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"greatest memory {memory_mb:.0f} MB")


def _field(rocks: int) -> SceneSpec:
    """Return the spec of a field with this many rocks on average, k = 0.19."""
    population = {"kind": "golombek-rapp", "k": 0.19, "d_min_m": 0.1, "d_max_m": 1.0}
    one_m = expected_count(PopulationSpec(**population, radius_m=1.0))
    table = {
        "population": {**population, "radius_m": float(np.sqrt(rocks / one_m))},
        "rocks": {"family": "rounded-polyhedron", "series": "random"},
        "camera": {"preset": "mer-navcam", "distance_m": 9.0, "elevation_deg": 25.0},
        "views": {"count": 2},
    }
    return convert_spec(table, where="field")


def _write(spec: SceneSpec, scene: SceneModel, backend: RendererName) -> None:
    """Write a whole scene whose rocks are made already."""
    dataset.build_scene = lambda *_: scene
    with TemporaryDirectory() as folder:
        dataset.write_scene(spec, 0, backend, Path(folder))


def _told(stage: str, start: float) -> float:
    now = time.process_time()
    print(f"{stage:18s} {now - start:7.2f} s", flush=True)
    return now


if __name__ == "__main__":
    main()
