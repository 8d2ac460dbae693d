"""`rockshape synth`: scenes, gravel beds and drawn shapes from the command line.

What makes them is imported when it is asked for, so that `--help` is fast.
"""

import argparse
import importlib
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, get_args

import msgspec

from synth.bed.command import add_bed_arguments, run_bed
from synth.dataset.arguments import (
    add_dataset_arguments,
    check_dataset_arguments,
    check_number,
)
from synth.errors import SpecError
from synth.spec import MAX_SCENES, RendererName, SceneSpec, convert_spec, load_spec
from synth.spec.dataset import LayoutName
from synth.spec.limits import MAX_COUNT
from synth.spec.sensor import SENSORS
from synth.spec.shapes import JITTER_RMS_PX, SERIES_NAMES
from synth.spec.site import DEFAULT as DEFAULT_SITE
from synth.spec.site import SITES, with_site
from synth.spec.toml import read_toml
from synth.spec.view import PresetName
from synth.spec.wording import expected_one_of

HELP = "generate rocks of known shape: scenes, gravel beds or drawn shapes, with their ground truth"

_SPEC_OPTIONS = ("spec", "site", "seed", "scenes", "rocks", "views", "camera", "renderer", "noise")
_DATASET_OPTIONS = ("split", "layout", "yolo")
_EXAMPLES = """examples:
  rockshape synth scene scenes --rocks 6 --views 4 --seed 1
  rockshape synth bed beds --tiles 100 --seed 1
"""
_SCENE_EXAMPLES = """examples:
  rockshape synth scene scenes --rocks 6 --views 4 --seed 1 --noise stereo
  rockshape synth scene again --replay scenes/manifest.json --jobs 2
"""
_SHAPES_EXAMPLES = """examples:
  rockshape synth shapes shapes --series roundness --count 4 --seed 1
  rockshape synth shapes uneven --series both --knobs 0.1,0.2,0.7
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the kinds of output and their options."""
    parser.epilog, parser.formatter_class = _EXAMPLES, argparse.RawDescriptionHelpFormatter
    kinds = parser.add_subparsers(title="kinds", metavar="KIND", dest="kind", required=True)
    scene = kinds.add_parser(
        "scene",
        help="rocks on a ground: images, depth, labels and ground truth (BOP layout)",
        description="Generate a dataset of rendered scenes in the BOP layout.",
        epilog=_SCENE_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_dataset_arguments(scene)
    scene.add_argument("--site", metavar="NAME", help=f"{_listed(SITES)} (default {DEFAULT_SITE})")
    scene.add_argument("--scenes", metavar="N", type=int, help="number of scenes (default 1)")
    scene.add_argument("--rocks", metavar="N", type=int, help="rocks in a scene (default 6)")
    scene.add_argument("--views", metavar="N", type=int, help="views of a scene (default 4)")
    scene.add_argument("--camera", metavar="PRESET", help=_listed(get_args(PresetName)))
    scene.add_argument("--renderer", metavar="NAME", help=_listed(get_args(RendererName)))
    scene.add_argument("--noise", metavar="KIND", help=f"range sensor: {_listed(SENSORS.names)}")
    scene.add_argument(
        "--split", metavar="SHARE", type=float, help="share of the scenes for training: COCO files"
    )
    scene.add_argument("--layout", metavar="NAME", help=_listed(get_args(LayoutName)))
    scene.add_argument(
        "--yolo",
        action="store_const",
        const=True,
        help="also pictures and label files as YOLO reads them",
    )
    scene.add_argument(
        "--plugin",
        metavar="MODULE",
        action="append",
        default=[],
        help="import a module that registers sensors or rock families",
    )
    add_bed_arguments(kinds)
    shapes = kinds.add_parser(
        "shapes",
        help="a series of drawn shapes: image, labels and ground truth",
        description="Draw a series of shapes whose outlines are known exactly.",
        epilog=_SHAPES_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    shapes.add_argument("out", metavar="OUT", type=Path, help="folder of the drawing")
    shapes.add_argument("--series", metavar="NAME", required=True, help=_listed(SERIES_NAMES))
    shapes.add_argument("--count", metavar="N", type=int, help="number of shapes (default 4)")
    shapes.add_argument("--size", metavar="PX", type=float, help="long side of every shape")
    shapes.add_argument(
        "--turn", metavar="DEG", type=float, default=0.0, help="anticlockwise turn (default 0)"
    )
    shapes.add_argument(
        "--knobs", metavar="V,V,…", help="values of the series' parameter, in place of even steps"
    )
    shapes.add_argument(
        "--jitter",
        metavar="PX",
        type=float,
        default=JITTER_RMS_PX,
        help=f"RMS jitter of the pen, px (default {JITTER_RMS_PX:g})",
    )
    shapes.add_argument("--seed", metavar="N", type=int, default=0, help="random seed (default 0)")


def run(args: argparse.Namespace) -> int:
    """Generate what was asked for and return 0.

    Raises:
        SpecError: an argument or a specification that cannot be used.
        MissingBackendError: the machine lacks the renderer.
        ReplayError: a dataset generated again is not the same.
    """
    run_kind = {"bed": run_bed, "scene": _run_scene, "shapes": _run_shapes}[args.kind]
    return run_kind(args)


def _run_shapes(args: argparse.Namespace) -> int:
    from synth.shapes.write import write_series  # noqa: PLC0415

    if args.seed < 0:
        raise SpecError(f"--seed: expected 0 or more, found {args.seed}")
    try:
        write_series(
            args.series,
            args.out,
            count=args.count,
            knobs=_numbers("--knobs", args.knobs),
            seed=args.seed,
            jitter_rms_px=args.jitter,
            size_px=args.size,
            turn_deg=args.turn,
        )
    except SpecError as error:
        raise SpecError(_named_as_option(str(error))) from error
    return 0


def _run_scene(args: argparse.Namespace) -> int:
    from synth.dataset.generate import generate_dataset  # noqa: PLC0415
    from synth.dataset.replay import replay_dataset  # noqa: PLC0415

    check_dataset_arguments(args, (*_SPEC_OPTIONS, *_DATASET_OPTIONS))
    for name in args.plugin:
        _import_plugin(name)
    if args.replay is not None:
        print(replay_dataset(args.replay, args.out, jobs=args.jobs, show_progress=True))
        return 0
    generate_dataset(_spec(args), args.out, jobs=args.jobs, show_progress=True)
    return 0


def _import_plugin(name: str) -> None:
    """Import a module, also of the current folder."""
    if str(Path.cwd()) not in sys.path:
        sys.path.append(str(Path.cwd()))
    try:
        importlib.import_module(name)
    except (Exception, SystemExit) as error:
        raise SpecError(
            f"--plugin: expected a module that can be imported, found {name!r}: "
            f"{type(error).__name__}: {error}"
        ) from error


def _named_as_option(text: str) -> str:
    """Complaint about an argument of `write_series` with the option's name."""
    name, _, rest = text.partition(":")
    options = {
        "series": "series",
        "count": "count",
        "knobs": "knobs",
        "jitter_rms_px": "jitter",
        "size_px": "size",
        "turn_deg": "turn",
    }
    return f"--{options[name]}:{rest}" if name in options else text


def _numbers(option: str, text: str | None) -> list[float] | None:
    """Comma-separated numbers, None where the option was not given."""
    if text is None:
        return None
    try:
        return [float(part) for part in text.split(",")]
    except ValueError as error:
        raise SpecError(f"{option}: expected comma-separated numbers, found {text!r}") from error


def _spec(args: argparse.Namespace) -> SceneSpec:
    """Spec of the file, or the default one, on a site and with the options laid over it."""
    _require("--camera", args.camera, get_args(PresetName))
    _require("--renderer", args.renderer, get_args(RendererName))
    _require("--layout", args.layout, get_args(LayoutName))
    _require("--noise", args.noise, SENSORS.names)
    for option, most in (("scenes", MAX_SCENES), ("views", MAX_COUNT)):
        check_number(args, option, most)
    check_number(args, "rocks", MAX_COUNT, least=0)
    _require("--site", args.site, SITES)
    said: Mapping[str, Any] = {}
    if args.spec is not None:
        load_spec(args.spec)  # a complaint names the file
        said = read_toml(args.spec)
    if args.site is not None:
        said = {**said, "site": args.site}
    where = "options" if args.spec is None else str(args.spec)
    spec = convert_spec(with_site(said, where=where), where=where)
    table = msgspec.to_builtins(spec)
    for part, key, value in (
        (table, "seed", args.seed),
        (table, "scenes", args.scenes),
        (table, "renderer", args.renderer),
        (table["rocks"], "count", args.rocks),
        (table["views"], "count", args.views),
        (table["camera"], "preset", args.camera),
        (table["noise"], "kind", args.noise),
    ):
        if value is not None:
            part[key] = value
    given = {name: getattr(args, name) for name in _DATASET_OPTIONS}
    given = {name: value for name, value in given.items() if value is not None}
    if given:
        table["dataset"] = {**table.get("dataset", {}), **given}
    return convert_spec(table, where="options")


def _require(option: str, value: str | None, names: Sequence[str]) -> None:
    if value is not None and value not in names:
        raise SpecError(f"{option}: {expected_one_of(value, names)}")


def _listed(names: Sequence[str]) -> str:
    return f"one of {', '.join(names)}" if len(names) > 1 else names[0]
