"""The stereo error model against a real matcher on the same views, at three picture qualities.

Run `python benchmarks/stereo_model.py --plot docs/images/stereo_model.png`. Each quality of the
pictures has its own four numbers, the same in every scene, range and camera: they were chosen on
seeds below 1000, of which `--seed 100` prints the tables, and are shown on seed 20000. Depth errors
are compared where both found a depth, by range; matches wrong by more than 3 px, which no normal
error is, are left out. Ranges where the model's error is over a twentieth of Z are left out too:
there σ_Z = Z² σ_d/(f B), a first order, is no law.
"""

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path
from time import perf_counter
from typing import Any

import matplotlib as mpl
import msgspec
import numpy as np
from numpy.typing import NDArray
from stereo_compare import GREYS, LAGS, MIN_PIXELS, Group, Pair, Quality, compared, half_px

from synth.light import light_scene
from synth.render import choose_backend, open_renderer, render_view
from synth.scene.scene import build_scene
from synth.sensor import capture_view
from synth.sensor.occlusion import contrast
from synth.sensor.rig import rig_of
from synth.spec import convert_spec
from synth.spec.sensor import NoiseSpec, SensorSpec

mpl.use("Agg")
from matplotlib import pyplot as plt
from matplotlib.ticker import NullFormatter

Floats = NDArray[np.float64]

_PRESETS = ("imp", "sojourner", "mer-hazcam", "mer-navcam", "msl-navcam", "mer-pancam")
_GROUNDS: tuple[dict[str, Any], ...] = (
    {},
    {
        "ground": {"slope_deg": 4.0, "ripple_height_m": 0.02, "pebbles_per_m2": 15.0},
        "surface": {"law": "lunar-lambert", "dust": 0.4},
        "sun": {"elevation_deg": 30.0},
    },
)
_FACTOR = 1.5
_TICKS_M = (1.0, 2.0, 5.0, 10.0)


def _model(
    disparity_px: float, weak_texture: float, locking_px: float, min_texture: float
) -> NoiseSpec:
    return NoiseSpec(
        kind="stereo",
        disparity_px=disparity_px,
        weak_texture=weak_texture,
        locking_px=locking_px,
        min_texture=min_texture,
    )


_NOISY = SensorSpec(full_well_e=20000.0, read_noise_e=25.0)
_FINE, _COARSE = (msgspec.structs.replace(_NOISY, jpeg_quality=quality) for quality in (85, 50))
_QUALITIES = (
    Quality("as rendered", SensorSpec(), _model(0.075, 0.8, 0.118, 0.0)),
    Quality("JPEG 85", _FINE, _model(0.10, 7.0, 0.107, 0.7)),
    Quality("JPEG 50", _COARSE, _model(0.15, 10.0, 0.055, 1.3)),
)


def main() -> None:
    """Print the comparison by preset and by quality; draw the plot."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--plot", type=Path)
    parser.add_argument("--seed", type=int, default=20000)
    parser.add_argument("--rows", action="store_true", help="print each range")
    args = parser.parse_args()
    groups = [group for preset in _PRESETS for group in _groups(preset, args.seed)]
    for quality in _QUALITIES:
        _print(quality, [group for group in groups if group.quality is quality], rows=args.rows)
    if args.plot is not None:
        _draw(groups, args.plot)


def _groups(preset: str, seed: int) -> Iterator[Group]:
    """Yield what a preset shows at each quality, over all grounds."""
    rig = rig_of(preset)
    pairs: dict[str, list[Pair]] = {quality.name: [] for quality in _QUALITIES}
    seconds = {quality.name: [0.0, 0.0] for quality in _QUALITIES}
    for number, table in enumerate(_GROUNDS):
        start_deg = float(37 * seed % 360)
        whole = {**table, "seed": seed + number, "camera": {"preset": preset}}
        spec = convert_spec(
            {**whole, "views": {"count": 1, "start_deg": start_deg}}, where=__file__
        )
        scene = build_scene(spec, 0)
        stage = light_scene(scene, spec.sun, spec.surface)
        renderer = open_renderer(choose_backend(spec.renderer), stage, scene.camera)
        view = render_view(renderer, stage, scene.camera, scene.poses[0], supersample=2)
        for quality in _QUALITIES:
            found = []
            for place, noise in enumerate((quality.model, NoiseSpec(kind="sgm"))):
                start = perf_counter()
                capture = capture_view(
                    view,
                    scene.poses[0],
                    spec=msgspec.structs.replace(spec, noise=noise, sensor=quality.sensor),
                    scene=0,
                    number=0,
                    camera=scene.camera,
                    stage=stage,
                    renderer=renderer,
                )
                seconds[quality.name][place] += (perf_counter() - start) / len(_GROUNDS)
                found.append(rig.disparity_px(capture.depth_m))
            exact_px = rig.disparity_px(view.depth_m)
            texture = contrast(view.light, NoiseSpec().window_px)
            pairs[quality.name].append(Pair(exact_px, found[0], found[1], texture))
    for quality in _QUALITIES:
        times = seconds[quality.name]
        yield compared(preset, quality, rig, pairs[quality.name], (times[0], times[1]))


def _print(quality: Quality, groups: Sequence[Group], *, rows: bool) -> None:
    """Print a quality's groups, and how many of its ranges agree."""
    model = quality.model
    print(
        f"{quality.name}: σ_d {model.disparity_px:g} px, weak texture {model.weak_texture:g}, "
        f"pull {model.locking_px:g} px, least texture {model.min_texture:g}"
    )
    print(
        "  preset      range m     rms ratio  median ratio  holes %           half-correlation px"
        "     off by > 1 px, %  s a view"
    )
    print(
        "                          model/matcher             mod. mat. both  row mod. mat.  "
        "col mod. mat.  edges  else"
    )
    for group in groups:
        ranges_m = [row.range_m for row in group.rows]
        rms, median = _ratios([group], "rms_m"), _ratios([group], "median_m")
        holes = 100.0 * np.array([*group.holes, group.common])
        off = 100.0 * np.array([group.off[1], group.off_else[1]])
        halves = [_length(half_px(one)) for one in (*group.along, *group.down)]
        print(
            f"  {group.preset:11}{min(ranges_m):5.1f}-{max(ranges_m):5.1f}  "
            f"{rms.min():5.2f}-{rms.max():4.2f}  {median.min():5.2f}-{median.max():4.2f}    "
            f"{holes[0]:4.1f} {holes[1]:4.1f} {holes[2]:4.1f}     "
            f"{halves[0]:>5} {halves[1]:>5}     {halves[2]:>5} {halves[3]:>5}   "
            f"{off[0]:5.1f} {off[1]:5.2f}    {group.seconds[0]:.2f} {group.seconds[1]:.2f}"
        )
        if rows:
            for row in group.rows:
                print(
                    f"      {row.range_m:7.2f} m {row.pixels:8d} px  rms "
                    f"{100 * row.rms_m[0]:8.3f} {100 * row.rms_m[1]:8.3f} cm  median "
                    f"{100 * row.median_m[0]:8.3f} {100 * row.median_m[1]:8.3f} cm"
                )
    table = np.sum([group.by_texture for group in groups], axis=0)
    print("  texture, grey levels      " + "".join(f"{low:7g}" for low in GREYS[:-1]))
    for side, name in ((1, "model"), (2, "matcher")):
        cells = [
            f"{np.sqrt(row[side] / row[0]):7.3f}" if row[0] > MIN_PIXELS else f"{'-':>7}"
            for row in table
        ]
        print(f"  RMS disparity, px, {name:7}" + "".join(cells))
    for name in ("rms_m", "median_m"):
        ratios = _ratios(groups, name)
        inside = ((ratios < _FACTOR) & (ratios > 1.0 / _FACTOR)).sum()
        print(
            f"  {name[:-2]}: model/matcher {ratios.min():.2f} to {ratios.max():.2f}, "
            f"{inside} of {len(ratios)} ranges within a factor of {_FACTOR}"
        )


def _length(half: float) -> str:
    return f"{half:.1f}" if np.isfinite(half) else f">{LAGS - 1}"


def _ratios(groups: Sequence[Group], name: str) -> Floats:
    """Return model over matcher of all ranges."""
    pairs = [getattr(row, name) for group in groups for row in group.rows]
    return np.array([model / matcher for model, matcher in pairs])


def _draw(groups: Sequence[Group], path: Path) -> None:
    """Draw depth errors by range above, autocorrelations of disparity errors below."""
    figure, axes = plt.subplots(
        2, len(_QUALITIES), figsize=(13.0, 8.0), layout="constrained", sharey="row"
    )
    for (above, below), quality in zip(axes.T, _QUALITIES, strict=True):
        mine = [group for group in groups if group.quality is quality]
        for number, group in enumerate(mine):
            _draw_errors(above, group, f"C{number}")
            _draw_likeness(below, group, f"C{number}")
        above.set(xscale="log", yscale="log", xlabel="z-depth, m")
        above.set_xticks(_TICKS_M, [f"{tick:g}" for tick in _TICKS_M])
        above.xaxis.set_minor_formatter(NullFormatter())
        above.set_title(
            f"{quality.name}: σ_d = {quality.model.disparity_px:g} px, "
            f"c₀ = {quality.model.weak_texture:g}, A = {quality.model.locking_px:g} px"
        )
        above.grid(visible=True, which="both", alpha=0.25)
        below.set(xlabel="distance along the row, px", ylim=(-0.2, 1.0))
        below.grid(visible=True, alpha=0.25)
    axes[0, 0].set_ylabel(f"RMS error of depth, cm (band: a factor of {_FACTOR})")
    axes[1, 0].set_ylabel("autocorrelation of disparity errors")
    axes[0, 0].legend(fontsize="small")
    figure.suptitle("Stereo error: the model (lines) and SGBM (points), seeds of their own")
    figure.savefig(path, dpi=80)
    plt.close(figure)


def _draw_errors(axes: Any, group: Group, colour: str) -> None:
    range_m = np.array([row.range_m for row in group.rows])
    model_cm, matcher_cm = 100.0 * np.array([row.rms_m for row in group.rows]).T
    axes.fill_between(
        range_m, model_cm / _FACTOR, model_cm * _FACTOR, color=colour, alpha=0.15, lw=0
    )
    axes.plot(range_m, model_cm, "-", color=colour, label=group.preset)
    axes.plot(range_m, matcher_cm, "o", color=colour, ms=4)


def _draw_likeness(axes: Any, group: Group, colour: str) -> None:
    lags_px = np.arange(LAGS)
    axes.plot(lags_px, group.along[0], "-", color=colour)
    axes.plot(lags_px, group.along[1], "o", color=colour, ms=4)


if __name__ == "__main__":
    main()
