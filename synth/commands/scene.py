"""`rockshape synth scene`: datasets of rendered scenes from the command line.

What makes them is imported when it is asked for, so that `--help` is fast.
"""

import argparse
import importlib
import sys
from collections.abc import Mapping
from concurrent.futures import Executor
from contextlib import nullcontext
from pathlib import Path
from typing import Any, TypedDict, get_args

import msgspec

from synth.commands.arguments import (
    add_dataset_arguments,
    check_dataset_arguments,
    check_name,
    check_number,
    listed,
)
from synth.errors import SpecError
from synth.spec import MAX_SCENES, RendererName, SceneSpec, convert_spec, load_spec
from synth.spec.dataset import LayoutName
from synth.spec.limits import MAX_COUNT
from synth.spec.sensor import SENSORS
from synth.spec.site import DEFAULT as DEFAULT_SITE
from synth.spec.site import SITES, with_site
from synth.spec.toml import read_toml
from synth.spec.view import PresetName

_SPEC_OPTIONS = ("spec", "site", "seed", "scenes", "rocks", "views", "camera", "renderer", "noise")
_DATASET_OPTIONS = ("split", "layout", "yolo")
_EXAMPLES = """examples:
  rockshape synth scene scenes --rocks 6 --views 4 --seed 1 --noise stereo
  rockshape synth scene again --replay scenes/manifest.json --jobs 2
"""


def add_scene_arguments(kinds: Any) -> None:
    """Declare the kind `scene` among the kinds of output."""
    scene: argparse.ArgumentParser = kinds.add_parser(
        "scene",
        help="rocks on a ground: images, depth, labels and ground truth (BOP layout)",
        description="Generate a dataset of rendered scenes in the BOP layout.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_dataset_arguments(scene)
    scene.add_argument("--site", metavar="NAME", help=f"{listed(SITES)} (default {DEFAULT_SITE})")
    scene.add_argument("--scenes", metavar="N", type=int, help="number of scenes (default 1)")
    scene.add_argument("--rocks", metavar="N", type=int, help="rocks in a scene (default 6)")
    scene.add_argument("--views", metavar="N", type=int, help="views of a scene (default 4)")
    scene.add_argument("--camera", metavar="PRESET", help=listed(get_args(PresetName)))
    scene.add_argument("--renderer", metavar="NAME", help=listed(get_args(RendererName)))
    scene.add_argument("--noise", metavar="KIND", help=f"range sensor: {listed(SENSORS.names)}")
    scene.add_argument(
        "--split", metavar="SHARE", type=float, help="share of the scenes for training: COCO files"
    )
    scene.add_argument("--layout", metavar="NAME", help=listed(get_args(LayoutName)))
    scene.add_argument(
        "--yolo",
        action="store_const",
        const=True,
        help="also pictures and label files as YOLO reads them",
    )
    scene.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="Dask scheduler in place of --jobs, tcp://host:8786; its workers write to OUT too",
    )
    scene.add_argument(
        "--plugin",
        metavar="MODULE",
        action="append",
        default=[],
        help="import a module that registers sensors or rock families",
    )


class _How(TypedDict):
    """How a dataset is made, which its bytes do not depend on."""

    jobs: int
    show_progress: bool
    executor: Executor | None


def run_scene(args: argparse.Namespace) -> int:
    """Generate the scenes and return 0.

    Raises:
        SpecError: an argument or a specification that cannot be used.
        MissingBackendError: the machine lacks the renderer.
        ReplayError: a dataset generated again is not the same.
    """
    from synth.dataset.generate import generate_dataset  # noqa: PLC0415
    from synth.dataset.replay import replay_dataset  # noqa: PLC0415
    from synth.handle.remote import cluster_executor  # noqa: PLC0415

    check_dataset_arguments(args, (*_SPEC_OPTIONS, *_DATASET_OPTIONS))
    for name in args.plugin:
        _import_plugin(name)
    spec = _spec(args) if args.replay is None else None
    with nullcontext() if args.scheduler is None else cluster_executor(args.scheduler) as executor:
        how = _How(jobs=args.jobs, show_progress=True, executor=executor)
        if spec is None:
            print(replay_dataset(args.replay, args.out, **how))
        else:
            generate_dataset(spec, args.out, **how)
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


def _spec(args: argparse.Namespace) -> SceneSpec:
    """Spec of the file, or the default one, on a site and with the options laid over it."""
    check_name("--camera", args.camera, get_args(PresetName))
    check_name("--renderer", args.renderer, get_args(RendererName))
    check_name("--layout", args.layout, get_args(LayoutName))
    check_name("--noise", args.noise, SENSORS.names)
    for option, most in (("scenes", MAX_SCENES), ("views", MAX_COUNT)):
        check_number(args, option, most)
    check_number(args, "rocks", MAX_COUNT, least=0)
    check_name("--site", args.site, SITES)
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
