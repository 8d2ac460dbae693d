"""`rockshape synth`: scenes and shapes from the command line."""

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import get_args

import msgspec

from synth.dataset.generate import generate_dataset
from synth.dataset.replay import replay_dataset
from synth.errors import SpecError
from synth.shapes import NAMES, write_series
from synth.shapes.write import JITTER_RMS_PX
from synth.spec import MAX_SCENES, RendererName, SceneSpec, convert_spec, load_spec
from synth.spec.limits import MAX_COUNT
from synth.spec.sensor import NoiseKind
from synth.spec.view import PresetName

HELP = "make rocks of known shape: rendered scenes, or drawn shapes, with their truth"

_MAX_SEED = 2**63
_SPEC_OPTIONS = ("spec", "seed", "scenes", "rocks", "views", "camera", "renderer", "noise")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the two kinds of output and their options."""
    kinds = parser.add_subparsers(title="kinds", metavar="KIND", dest="kind", required=True)
    scene = kinds.add_parser("scene", help="rocks on a plain: image, depth, labels, truth (BOP)")
    scene.add_argument("out", metavar="OUT", type=Path, help="folder of the dataset")
    scene.add_argument("--spec", metavar="FILE.toml", type=Path, help="the dataset's description")
    scene.add_argument("--seed", metavar="N", type=int, help="seed of all randomness")
    scene.add_argument("--scenes", metavar="N", type=int, help="number of scenes")
    scene.add_argument("--rocks", metavar="N", type=int, help="rocks in a scene")
    scene.add_argument("--views", metavar="N", type=int, help="camera stations round a scene")
    scene.add_argument("--camera", metavar="PRESET", help=_listed(get_args(PresetName)))
    scene.add_argument("--renderer", metavar="NAME", help=_listed(get_args(RendererName)))
    scene.add_argument("--noise", metavar="KIND", help=f"the range: {_listed(get_args(NoiseKind))}")
    scene.add_argument("--jobs", metavar="N", type=int, default=1, help="processes (default 1)")
    scene.add_argument(
        "--replay", metavar="MANIFEST.json", type=Path, help="make a dataset again, compare hashes"
    )
    shapes = kinds.add_parser("shapes", help="a row of drawn shapes: image, labels, truth")
    shapes.add_argument("out", metavar="OUT", type=Path, help="folder of the drawing")
    shapes.add_argument("--series", metavar="NAME", required=True, help=_listed(NAMES))
    shapes.add_argument("--count", metavar="N", type=int, help="shapes (default 4)")
    shapes.add_argument(
        "--knobs", metavar="V,V,…", help="the shapes' own knob values, in place of even steps"
    )
    shapes.add_argument(
        "--jitter", metavar="PX", type=float, default=JITTER_RMS_PX, help="the pen's, RMS (0.35)"
    )
    shapes.add_argument("--seed", metavar="N", type=int, default=0, help="seed (default 0)")


def run(args: argparse.Namespace) -> int:
    """Make what was asked for and return 0.

    Raises:
        InputError: an argument or a spec that cannot be used.
        MissingBackendError: the machine lacks the renderer.
        ReplayError: a dataset made again is not the same.
    """
    if args.kind == "shapes":
        if args.seed < 0:
            raise SpecError(f"--seed: expected 0 or more, found {args.seed}")
        write_series(
            args.series,
            args.out,
            count=args.count,
            knobs=_numbers("--knobs", args.knobs),
            seed=args.seed,
            jitter_rms_px=args.jitter,
        )
        return 0
    if args.jobs < 1:
        raise SpecError(f"--jobs: expected 1 or more, found {args.jobs}")
    if args.replay is not None:
        _refuse_beside_replay(args)
        print(replay_dataset(args.replay, args.out, jobs=args.jobs, show_progress=True))
        return 0
    generate_dataset(_spec(args), args.out, jobs=args.jobs, show_progress=True)
    return 0


def _refuse_beside_replay(args: argparse.Namespace) -> None:
    """Refuse options that would describe another dataset than the manifest's."""
    for option in _SPEC_OPTIONS:
        if getattr(args, option) is not None:
            raise SpecError(
                f"--{option}: expected none beside --replay, whose manifest holds the spec, "
                f"found {getattr(args, option)}"
            )


def _numbers(option: str, text: str | None) -> list[float] | None:
    """Return numbers that commas part, None where the option was not given."""
    if text is None:
        return None
    try:
        return [float(part) for part in text.split(",")]
    except ValueError as error:
        raise SpecError(f"{option}: expected numbers parted by commas, found {text!r}") from error


def _spec(args: argparse.Namespace) -> SceneSpec:
    """Return the spec of the file, or the default one, with the options laid over it."""
    _require("--camera", args.camera, get_args(PresetName))
    _require("--renderer", args.renderer, get_args(RendererName))
    _require("--noise", args.noise, get_args(NoiseKind))
    for option, most in (("scenes", MAX_SCENES), ("rocks", MAX_COUNT), ("views", MAX_COUNT)):
        value = getattr(args, option)
        if value is not None and not 1 <= value <= most:
            raise SpecError(f"--{option}: expected 1 to {most}, found {value}")
    if args.seed is not None and not 0 <= args.seed < _MAX_SEED:
        raise SpecError(f"--seed: expected 0 or more, below 2^63, found {args.seed}")
    spec = SceneSpec() if args.spec is None else load_spec(args.spec)
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
    return convert_spec(table, where="options")


def _require(option: str, value: str | None, names: Sequence[str]) -> None:
    if value is not None and value not in names:
        raise SpecError(f"{option}: expected {_listed(names)}, found {value!r}")


def _listed(names: Sequence[str]) -> str:
    return f"one of {', '.join(names)}" if len(names) > 1 else names[0]
