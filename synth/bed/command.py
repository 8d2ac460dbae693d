"""`rockshape synth bed`: datasets of gravel beds from the command line.

What makes them is imported when it is asked for, so that `--help` is fast.
"""

import argparse
from pathlib import Path
from typing import Any

import msgspec

from synth.errors import SpecError
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
        help="gravel beds from above: images, instance labels, heights and COCO annotations",
        description="Generate tiles of gravel beds with the truth of each grain.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("out", metavar="OUT", type=Path, help="folder of the dataset")
    parser.add_argument("--spec", metavar="FILE.toml", type=Path, help="specification of the tiles")
    parser.add_argument("--seed", metavar="N", type=int, help="random seed (default 0)")
    parser.add_argument("--tiles", metavar="N", type=int, help="number of tiles (default 1)")
    parser.add_argument("--jobs", metavar="N", type=int, default=1, help="processes (default 1)")
    parser.add_argument(
        "--replay",
        metavar="MANIFEST.json",
        type=Path,
        help="generate a manifest's dataset again and compare the hash of every file",
    )


def run_bed(args: argparse.Namespace) -> int:
    """Generate the tiles and return 0.

    Raises:
        SpecError: an argument or a specification that cannot be used.
        ReplayError: a dataset generated again is not the same.
    """
    from synth.bed.write import replay_beds, write_beds  # noqa: PLC0415

    if args.jobs < 1:
        raise SpecError(f"--jobs: expected 1 or more, found {args.jobs}")
    if args.replay is not None:
        for option in _SPEC_OPTIONS:
            if getattr(args, option) is not None:
                raise SpecError(
                    f"--{option}: expected none beside --replay, whose manifest holds the spec, "
                    f"found {getattr(args, option)}"
                )
        print(replay_beds(args.replay, args.out, jobs=args.jobs, show_progress=True))
        return 0
    write_beds(_spec(args), args.out, jobs=args.jobs, show_progress=True)
    return 0


def _spec(args: argparse.Namespace) -> BedSpec:
    if args.seed is not None and not 0 <= args.seed < 2**63:
        raise SpecError(f"--seed: expected 0 or more, below 2^63, found {args.seed}")
    if args.tiles is not None and not 1 <= args.tiles <= MAX_TILES:
        raise SpecError(f"--tiles: expected 1 to {MAX_TILES}, found {args.tiles}")
    spec = BedSpec() if args.spec is None else load_bed_spec(args.spec)
    table = msgspec.to_builtins(spec)
    given = {"seed": args.seed, "tiles": args.tiles}
    table |= {name: value for name, value in given.items() if value is not None}
    return convert_bed_spec(table, where="options")
