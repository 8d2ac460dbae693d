"""Stereo error model against a matcher on the same views, at three picture qualities."""

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

import msgspec
import numpy as np
from case import Case, Cell, Column, Table
from numpy.typing import NDArray
from stereo_compare import GREYS, LAGS, MIN_PIXELS, Group, Pair, Quality, compared, half_px
from timing import timed

from synth.light import light_scene
from synth.render import choose_backend, open_renderer, render_view
from synth.scene.scene import build_scene
from synth.sensor import capture_view
from synth.sensor.occlusion import contrast
from synth.sensor.rig import Rig, rig_of
from synth.spec import convert_spec
from synth.spec.sensor import NoiseSpec, SensorSpec

SEED = 20_000
FACTOR = 1.5
PRESETS = ("imp", "sojourner", "mer-hazcam", "mer-navcam", "msl-navcam", "mer-pancam")
GROUNDS: tuple[dict[str, Any], ...] = (
    {},
    {
        "ground": {"slope_deg": 4.0, "ripple_height_m": 0.02, "pebbles_per_m2": 15.0},
        "surface": {"law": "lunar-lambert", "dust": 0.4},
        "sun": {"elevation_deg": 30.0},
    },
)


def _quality(name: str, jpeg: int | None, *numbers: float) -> Quality:
    """Return pictures of a kind with the model's σ_d, c₀, A and least texture.

    The numbers are the same in every scene, range and camera; they were chosen on seeds below 1000.
    """
    noisy = {} if jpeg is None else {"full_well_e": 20000.0, "read_noise_e": 25.0}
    keys = ("disparity_px", "weak_texture", "locking_px", "min_texture")
    model = NoiseSpec(kind="stereo", **dict(zip(keys, numbers, strict=True)))
    return Quality(name, SensorSpec(jpeg_quality=jpeg, **noisy), model)


QUALITIES = (
    _quality("as rendered", None, 0.075, 0.8, 0.118, 0.0),
    _quality("JPEG 85", 85, 0.10, 7.0, 0.107, 0.7),
    _quality("JPEG 50", 50, 0.15, 10.0, 0.055, 1.3),
)


def model_and_matcher(*, presets: tuple[str, ...] = PRESETS, grounds: int = 2) -> list[Table]:
    """Compare errors of depth and disparity, holes and correlation of the errors."""
    groups = [group for preset in presets for group in preset_groups(preset, grounds)]
    rows: list[tuple[Cell, ...]] = []
    textures: list[tuple[Cell, ...]] = []
    for quality in QUALITIES:
        mine = [group for group in groups if group.quality is quality]
        rows += [(quality.name, *_row(group)) for group in mine]
        totals = np.sum([group.by_texture for group in mine], axis=0)
        for side, name in ((1, "model"), (2, "matcher")):
            rms = [np.sqrt(t[side] / t[0]) if t[0] > MIN_PIXELS else None for t in totals]
            textures.append((quality.name, name, *rms))
    heads = ("holes, model", "matcher", "both")
    columns = (
        Column("pictures"),
        Column("preset"),
        Column("range", "m"),
        Column("RMS ratio"),
        Column("median ratio"),
        Column(f"ranges within {FACTOR}"),
        *(Column(head, "%", ".1f") for head in heads),
        Column("half-correlation along rows, model / matcher", "px"),
        Column("along columns", "px"),
        Column("matcher off by > 1 px, at edges", "%", ".1f"),
        Column("elsewhere", "%", ".2f"),
        Column("a view, model / matcher", "s"),
    )
    greys = [Column(f"{low:g}", "", ".3f") for low in GREYS[:-1]]
    return [
        Table(columns, rows, name="depth"),
        Table((Column("pictures"), Column("RMS disparity error, px"), *greys), textures, "texture"),
    ]


def _row(group: Group) -> list[Cell]:
    """Return a preset's cells; ratios are of model over matcher, over its ranges."""
    ranges_m = [row.range_m for row in group.rows]
    ratios = {name: ratio_of([group], name) for name in ("rms_m", "median_m")}
    inside = sum(((r < FACTOR) & (r > 1 / FACTOR)).sum() for r in ratios.values())
    halves = [_length(half_px(one)) for one in (*group.along, *group.down)]
    return [
        group.preset,
        f"{min(ranges_m):.1f} to {max(ranges_m):.1f}",
        *(f"{r.min():.2f} to {r.max():.2f}" for r in ratios.values()),
        f"{inside} of {2 * len(ranges_m)}",
        *(100 * share for share in (*group.holes, group.common)),
        f"{halves[0]} / {halves[1]}",
        f"{halves[2]} / {halves[3]}",
        100 * group.off[1],
        100 * group.off_else[1],
        f"{group.seconds[0]:.2f} / {group.seconds[1]:.2f}",
    ]


def _length(half: float) -> str:
    return f"{half:.1f}" if np.isfinite(half) else f">{LAGS - 1}"


def ratio_of(groups: Sequence[Group], name: str) -> NDArray[np.float64]:
    """Return model over matcher of all ranges."""
    pairs = [getattr(row, name) for group in groups for row in group.rows]
    return np.array([model / matcher for model, matcher in pairs])


def _capture(found: list[Any], rig: Rig, view: Any, pose: Any, **settings: Any) -> None:
    """Capture a view, and keep the disparities measured in it."""
    taken = capture_view(view, pose, **settings)
    found.append(rig.disparity_px(taken.depth_m))


def preset_groups(preset: str, grounds: int = len(GROUNDS)) -> Iterator[Group]:
    """Yield what a preset shows at each quality, over the grounds together."""
    rig = rig_of(preset)
    pairs: dict[str, list[Pair]] = {quality.name: [] for quality in QUALITIES}
    seconds = {quality.name: np.zeros(2) for quality in QUALITIES}
    for number, ground in enumerate(GROUNDS[:grounds]):
        views = {"count": 1, "start_deg": float(37 * SEED % 360)}
        table = {**ground, "seed": SEED + number, "camera": {"preset": preset}, "views": views}
        spec = convert_spec(table, where="stereo_model")
        scene = build_scene(spec, 0)
        stage = light_scene(scene, spec.sun, spec.surface)
        renderer = open_renderer(choose_backend(spec.renderer), stage, scene.camera)
        view = render_view(renderer, stage, scene.camera, scene.poses[0], supersample=2)
        for quality in QUALITIES:
            found: list[NDArray[np.float64]] = []
            for place, noise in enumerate((quality.model, NoiseSpec(kind="sgm"))):
                whole = msgspec.structs.replace(spec, noise=noise, sensor=quality.sensor)
                call = partial(
                    _capture,
                    found,
                    rig,
                    view,
                    scene.poses[0],
                    spec=whole,
                    scene=0,
                    number=0,
                    camera=scene.camera,
                    stage=stage,
                    renderer=renderer,
                )
                seconds[quality.name][place] += timed(call).cpu_s / grounds
            exact_px = rig.disparity_px(view.depth_m)
            texture = contrast(view.light, NoiseSpec().window_px)
            pairs[quality.name].append(Pair(exact_px, found[0], found[1], texture))
    for quality in QUALITIES:
        model_s, matcher_s = seconds[quality.name].tolist()
        yield compared(preset, quality, rig, pairs[quality.name], (model_s, matcher_s))


STEREO_MODEL_CASE = Case(
    name="stereo_model",
    what="stereo error model beside OpenCV's StereoSGBM on the same views, seeds of their own",
    run=model_and_matcher,
    smallest={"presets": ("imp",), "grounds": 1},
)
