"""Cost of rendering: a view, memory over many frames, and a field of many rocks."""

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from bare import BareRenderer
from case import Case, Cell, Column, Table
from timing import in_fresh_process, memory_mb, timed, timed_with_children

from synth.camera.pose import Pose
from synth.dataset.workers import worker_pool
from synth.dataset.write import write_scene
from synth.light import light_scene
from synth.render import choose_backend, open_renderer, render_view
from synth.render.backends import BACKENDS, has_backend
from synth.render.view import depth_limits_m
from synth.scene.population import expected_count
from synth.scene.scene import build_scene
from synth.spec import SceneSpec, convert_spec
from synth.spec.population import PopulationSpec


def _backends() -> list[str]:
    """Return the backends that this machine has."""
    return [backend for backend in BACKENDS if has_backend(backend)]


def view_cost(
    *, backends: int = 3, preset: str = "msl-navcam", views: int = 5, scenes: int = 3
) -> list[Table]:
    """Time further views of six rocks, with and without files, beside the bare renderer."""
    options = (preset, views, scenes)
    rows: list[tuple[Cell, ...]] = [
        (backend, *in_fresh_process(_view_cost, backend, *options))
        for backend in _backends()[-backends:]
    ]
    heads = ("view", "view and files", "bare", "bare geometry", "scene of one view")
    columns = (Column("backend"), *(Column(head, "ms", ".0f") for head in heads))
    return [Table((*columns, Column("ratio", "", ".2f")), rows)]


def _view_cost(backend: str, preset: str, views: int, scenes: int) -> tuple[float, ...]:
    """Return one backend's milliseconds of processor time, and a view's ratio to the bare one."""
    _seconds(backend, preset, views=2, seed=0)  # warms up
    spent = [_seconds(backend, preset, views=views, seed=seed) for seed in range(1, scenes + 1)]
    means_ms = 1e3 * np.mean(spent, axis=0)
    return (*means_ms, means_ms[0] / means_ms[2])


def _seconds(backend: str, preset: str, *, views: int, seed: int) -> tuple[float, ...]:
    """Return seconds: a view, with its files, bare, bare geometry; and a scene of one view."""
    table = {"seed": seed, "rocks": {"count": 6}, "camera": {"preset": preset}}
    single, spec = (
        convert_spec({**table, "views": {"count": count}}, where="view_cost")
        for count in (1, views)
    )
    scene = build_scene(spec, 0)
    stage = light_scene(scene, spec.sun, spec.surface)
    renderer = open_renderer(backend, stage, scene.camera)
    bare = BareRenderer(backend, stage, scene.camera, spec.camera.supersample)

    def render(pose: Pose) -> None:
        render_view(renderer, stage, scene.camera, pose, supersample=spec.camera.supersample)

    first, *others = scene.poses
    bare.seconds(first)
    render(first)
    own_s = sum(timed(lambda pose=pose: render(pose)).cpu_s for pose in others)
    bare_s = np.sum([bare.seconds(pose) for pose in others], axis=0)
    with TemporaryDirectory() as folder:
        one_s = timed(lambda: write_scene(single, 0, backend, Path(folder) / "one")).cpu_s
        all_s = timed(lambda: write_scene(spec, 0, backend, Path(folder) / "all")).cpu_s
    further = len(others)
    return own_s / further, (all_s - one_s) / further, *(bare_s / further), one_s


def memory(*, backends: int = 3, every: int = 50, upto: int = 300) -> list[Table]:
    """Return the resident memory of a process that writes scene after scene of ten frames."""
    shown = tuple(range(every, upto + 1, every))
    rows = [
        (backend, *in_fresh_process(_resident_mb, backend, shown))
        for backend in _backends()[-backends:]
    ]
    columns = (Column("backend"), *(Column(f"{n} frames", "MB", ".0f") for n in shown))
    return [Table(columns, rows)]


def _resident_mb(backend: str, shown: tuple[int, ...]) -> list[float]:
    table = {"seed": 2, "camera": {"preset": "imp"}, "views": {"count": 10}}
    spec = convert_spec({**table, "scenes": shown[-1] // 10}, where="memory")
    found = []
    for index in range(spec.scenes):
        with TemporaryDirectory() as folder:
            write_scene(spec, index, backend, Path(folder))
        if 10 * (index + 1) in shown:
            found.append(memory_mb())
    return found


def field(*, rocks: int = 500, preset: str = "mer-navcam") -> list[Table]:
    """Time each stage of a field of many rocks."""
    columns = (
        Column("rocks", "", "d"),
        Column("facets", "", ",d"),
        Column("rocks and their places", "s"),
        Column("by two processes more", "s"),
        Column("wall", "s"),
        Column("light", "s"),
        Column("further view", "s"),
        Column("its geometry alone", "s"),
        Column("peak memory", "MB", ",.0f"),
    )
    return [Table(columns, [in_fresh_process(_field, rocks, preset)])]


def _field(rocks: int, preset: str) -> tuple[float, ...]:
    spec, backend = field_spec(rocks, preset), choose_backend("auto")
    made: dict[str, Any] = {}

    def keep(name: str, value: Any) -> None:
        made[name] = value

    build = timed(lambda: keep("scene", build_scene(spec, 0)))
    scene = made["scene"]

    def build_by_processes() -> None:
        with worker_pool(2) as pool:
            build_scene(spec, 0, pool=pool)

    shared = timed_with_children(build_by_processes)
    light = timed(lambda: keep("stage", light_scene(scene, spec.sun, spec.surface)))
    stage = made["stage"]
    renderer = open_renderer(backend, stage, scene.camera)
    fine = open_renderer(backend, stage, scene.camera.refined(2))
    first, pose = scene.poses
    render_view(renderer, stage, scene.camera, first, supersample=2)
    view = timed(lambda: render_view(renderer, stage, scene.camera, pose, supersample=2))
    limits_m = depth_limits_m(stage, scene.camera, pose)
    geometry = timed(
        lambda: (renderer.measure(pose, limits_m, None), fine.measure(pose, limits_m, None))
    )
    return (
        len(scene.rocks),
        sum(len(rock.mesh.faces) for rock in scene.rocks),
        build.cpu_s,
        shared.cpu_s,
        shared.wall_s,
        *(one.cpu_s for one in (light, view, geometry)),
        memory_mb(peak=True),
    )


def field_spec(rocks: int, preset: str, *, views: int = 2) -> SceneSpec:
    """Return the spec of a field with this many rocks on average, k = 0.19."""
    population = {"kind": "golombek-rapp", "k": 0.19, "d_min_m": 0.1, "d_max_m": 1.0}
    one_m = expected_count(PopulationSpec(**population, radius_m=1.0))
    table = {
        "population": {**population, "radius_m": float(np.sqrt(rocks / one_m))},
        "rocks": {"family": "rounded-polyhedron", "series": "random"},
        "camera": {"preset": preset, "distance_m": 9.0, "elevation_deg": 25.0},
        "views": {"count": views},
    }
    return convert_spec(table, where="field")


VIEW_COST_CASE = Case(
    name="view_cost",
    what="processor time of a further view of six rocks, beside the bare renderer",
    run=view_cost,
    smallest={"backends": 1, "preset": "imp", "views": 2, "scenes": 1},
    peer="the renderer's library called directly for a picture with shadows, depth and labels",
)

MEMORY_CASE = Case(
    name="memory",
    what="resident memory of one process that writes scene after scene of 256² frames",
    run=memory,
    smallest={"backends": 1, "every": 10, "upto": 10},
)

FIELD_CASE = Case(
    name="field",
    what="processor time and memory of a field of many rocks, k = 0.19",
    run=field,
    smallest={"rocks": 5, "preset": "imp"},
)
