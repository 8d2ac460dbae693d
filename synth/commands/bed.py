"""`rockshape synth bed`: datasets of gravel beds from the command line.

What makes them is imported when it is asked for, so that `--help` is fast.
"""

import argparse
from typing import Any

import msgspec

from synth.commands.arguments import (
    add_dataset_arguments,
    check_dataset_arguments,
    check_number,
)
from synth.spec.bed import MAX_TILES, BedSpec, convert_bed_spec, load_bed_spec

_EXAMPLES = """examples:
  rockshape synth bed beds --tiles 100 --seed 1 --jobs 2
  rockshape synth bed beds --spec gravel.toml
"""
_SPEC_OPTIONS = ("spec", "seed", "tiles")


def add_bed_arguments(kinds: Any) -> None:
    """Declare the kind `bed` among the kinds of output."""
    parser: argparse.ArgumentParser = kinds.add_parser(
        "bed",
        help="gravel beds: images, instance labels, heights and COCO annotations",
        description="Generate tiles of gravel beds with the truth of each grain.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_dataset_arguments(parser)
    parser.add_argument("--tiles", metavar="N", type=int, help="number of tiles (default 1)")


def run_bed(args: argparse.Namespace) -> int:
    """Generate the tiles and return 0.

    Raises:
        SpecError: an argument or a specification that cannot be used.
        ReplayError: a dataset generated again is not the same.
    """
    from synth.bed.write import replay_beds, write_beds  # noqa: PLC0415

    check_dataset_arguments(args, _SPEC_OPTIONS)
    if args.replay is not None:
        print(replay_beds(args.replay, args.out, jobs=args.jobs, show_progress=True))
        return 0
    write_beds(_spec(args), args.out, jobs=args.jobs, show_progress=True)
    return 0


def _spec(args: argparse.Namespace) -> BedSpec:
    check_number(args, "tiles", MAX_TILES)
    spec = BedSpec() if args.spec is None else load_bed_spec(args.spec)
    table = msgspec.to_builtins(spec)
    given = {"seed": args.seed, "tiles": args.tiles}
    table |= {name: value for name, value in given.items() if value is not None}
    return convert_bed_spec(table, where="options")
