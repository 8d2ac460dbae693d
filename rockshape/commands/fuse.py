"""`rockshape fuse`: the command's arguments."""

import argparse
from pathlib import Path

from rockshape.commands.parser import examples

HELP = "measure rocks seen from several sides, one row a rock"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.epilog = examples(
        "rockshape fuse field/000000 --out rocks.csv --views sights.csv",
        "rockshape fuse frames.toml --poses given",
    )
    parser.add_argument(
        "frames",
        type=Path,
        metavar="SCENE|FRAMES",
        help="scene folder in BOP's format with poses, or a JSON or TOML list of frames",
    )
    parser.add_argument(
        "--labels",
        metavar="FOLDER",
        help="folder of the scene with label images or masks of its rocks, mask_visib say",
    )
    parser.add_argument(
        "--method",
        default="robust",
        metavar="NAME",
        help="what is measured: robust (default), paper, or a method that a plug-in adds",
    )
    parser.add_argument(
        "--poses",
        choices=("refined", "given"),
        default="refined",
        help="poses refined by the range (default), or as they are given",
    )
    parser.add_argument(
        "--out",
        type=Path,
        metavar="FILE",
        help="table of one row a rock: .csv, .json or .parquet (default: CSV on standard output)",
    )
    parser.add_argument(
        "--views", type=Path, metavar="FILE", help="table of one row a rock and view, likewise"
    )


def run(args: argparse.Namespace) -> int:
    """Fuse the views and write what was asked for."""
    from rockshape.commands.fuse_frames import (  # noqa: PLC0415 - brings NumPy, SciPy and pandas
        FuseOptions,
        fuse_frames,
    )

    names = FuseOptions.__dataclass_fields__
    fuse_frames(FuseOptions(**{name: getattr(args, name) for name in names}))
    return 0
