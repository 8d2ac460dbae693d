"""Command-line arguments that kinds of dataset share, and checks of names and numbers."""

import argparse
from collections.abc import Iterable, Sequence
from pathlib import Path

from synth.errors import SpecError
from synth.spec.wording import expected_one_of

MAX_SEED = 2**63


def add_dataset_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the folder, the specification, the seed, the processes and the replay."""
    parser.add_argument("out", metavar="OUT", type=Path, help="folder of the dataset")
    parser.add_argument(
        "--spec", metavar="FILE.toml", type=Path, help="specification to start from"
    )
    parser.add_argument("--seed", metavar="N", type=int, help="random seed (default 0)")
    parser.add_argument("--jobs", metavar="N", type=int, default=1, help="processes (default 1)")
    parser.add_argument(
        "--replay",
        metavar="MANIFEST.json",
        type=Path,
        help="generate a manifest's dataset again and compare the hash of every file",
    )


def check_dataset_arguments(args: argparse.Namespace, options: Iterable[str]) -> None:
    """Check the seed and the processes, and that no other option stands beside --replay.

    Raises:
        SpecError: one of them cannot be used; `options` describe a dataset, as the manifest does.
    """
    if args.jobs < 1:
        raise SpecError(f"--jobs: expected 1 or more, found {args.jobs}")
    if args.seed is not None and not 0 <= args.seed < MAX_SEED:
        raise SpecError(f"--seed: expected 0 or more, below 2^63, found {args.seed}")
    for option in options if args.replay is not None else ():
        if getattr(args, option) is not None:
            raise SpecError(
                f"--{option}: expected none beside --replay, whose manifest holds the spec, "
                f"found {getattr(args, option)}"
            )


def check_number(args: argparse.Namespace, option: str, most: int, *, least: int = 1) -> None:
    """Check that an option, if it is given, is from `least` to `most`.

    Raises:
        SpecError: it is not.
    """
    value = getattr(args, option)
    if value is not None and not least <= value <= most:
        raise SpecError(f"--{option}: expected {least} to {most}, found {value}")


def check_name(option: str, value: str | None, names: Sequence[str]) -> None:
    """Check that an option, if it is given, is one of the names.

    Raises:
        SpecError: it is not.
    """
    if value is not None and value not in names:
        raise SpecError(f"{option}: {expected_one_of(value, names)}")


def listed(names: Sequence[str]) -> str:
    """Names as the help of an option has them."""
    return f"one of {', '.join(names)}" if len(names) > 1 else names[0]
