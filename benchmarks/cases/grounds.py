"""Cost of grounds by stage: heights and pebbles, rays and shading."""

from collections.abc import Callable
from typing import TypeVar

from case import Case, Column, Table
from timing import timed

from synth.light import light_scene
from synth.render import open_renderer, render_view
from synth.scene.scene import build_scene
from synth.spec import convert_spec
from synth.spec.site import SITES, with_site

T = TypeVar("T")


def stages(*, preset: str = "msl-navcam", sites: int = len(SITES)) -> list[Table]:
    """Time a scene of six rocks and one view on each site, by Embree, on the plain last."""
    columns = (
        Column("site"),
        Column("triangles of the ground, 1000", "", ".0f"),
        *(Column(name, "s", ".1f") for name in ("scene", "rays made ready", "view")),
    )
    return [Table(columns, [_row(site, preset) for site in SITES[-sites:]])]


def _row(site: str, preset: str) -> tuple[str | float, ...]:
    """Return one site's triangles and its seconds of processor time."""
    said = {"site": site, "camera": {"preset": preset}, "views": {"count": 1}, "seed": 10_001}
    spec = convert_spec(with_site(said, where="grounds"), where="grounds")
    scene, scene_s = _timed(lambda: build_scene(spec, 0))
    stage, stage_s = _timed(lambda: light_scene(scene, spec.sun, spec.surface))
    renderer = open_renderer("embree", stage, scene.camera)
    _, view_s = _timed(
        lambda: render_view(renderer, stage, scene.camera, scene.poses[0], supersample=2)
    )
    triangles = sum(len(body.faces) for body in stage.ground)
    return site, triangles / 1000, scene_s, stage_s, view_s


def _timed(call: Callable[[], T]) -> tuple[T, float]:
    """Return what a call returns, and its seconds of processor time."""
    found: list[T] = []
    seconds = timed(lambda: found.append(call())).cpu_s
    return found[0], seconds


GROUNDS_CASE = Case(
    name="grounds",
    what="a scene of six rocks on each site, by stage",
    run=stages,
    smallest={"preset": "imp", "sites": 1},
)
