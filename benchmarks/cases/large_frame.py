"""Cost of a large frame of a field: its rocks, the view, and the files behind it."""

from pathlib import Path
from tempfile import TemporaryDirectory

from case import Case, Cell, Column, Table
from cases.rendering_cost import field_spec
from timing import in_fresh_process, memory_mb, timed, timed_with_children

from synth.dataset.write import capture_frame, write_scene
from synth.light import spec_stage
from synth.render import choose_backend, open_renderer
from synth.scene.scene import SceneModel, build_scene


def large_frame(*, rocks: int = 100, preset: str = "m2020-navcam") -> list[Table]:
    """Time one view of a field of rocks: made, rendered, and the whole scene with its files."""
    columns = (
        Column("frame, px"),
        Column("rocks", "", "d"),
        Column("rocks and their places", "s"),
        Column("view", "s"),
        Column("all with files", "s"),
        Column("masks and tables, a rock", "s", ".2f"),
        Column("all with two jobs", "s"),
        Column("wall", "s"),
        Column("peak memory", "MB", ",.0f"),
    )
    return [Table(columns, [in_fresh_process(_large_frame, rocks, preset)])]


def _large_frame(rocks: int, preset: str) -> tuple[Cell, ...]:
    spec, backend = field_spec(rocks, preset, views=1), choose_backend("auto")
    with TemporaryDirectory() as folder:
        whole_s = timed(lambda: write_scene(spec, 0, backend, Path(folder))).cpu_s
    peak_mb = memory_mb(peak=True)
    with TemporaryDirectory() as folder:
        shared = timed_with_children(lambda: write_scene(spec, 0, backend, Path(folder), jobs=2))
    made: list[SceneModel] = []
    build_s = timed(lambda: made.append(build_scene(spec, 0))).cpu_s
    (scene,) = made

    def view() -> None:
        stage = spec_stage(spec, 0, scene)
        renderer = open_renderer(backend, stage, scene.camera)
        capture_frame(spec, 0, 0, scene=scene, stage=stage, renderer=renderer)

    view_s, count = timed(view).cpu_s, len(scene.rocks)
    rest_s = max(whole_s - build_s - view_s, 0.0) / count
    shape = f"{scene.camera.width}×{scene.camera.height}"
    return shape, count, build_s, view_s, whole_s, rest_s, shared.cpu_s, shared.wall_s, peak_mb


LARGE_FRAME_CASE = Case(
    name="large_frame",
    what="processor time and memory of a frame of 20 million pixels of a field, with its files",
    run=large_frame,
    smallest={"rocks": 3, "preset": "imp"},
)
