"""`rockshape summarise`: the command's arguments."""

import argparse
from pathlib import Path

from rockshape.commands.parser import examples

HELP = "tell sizes, sorting, shape classes and abundance of the rocks in tables"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.epilog = examples(
        "rockshape summarise grains.csv",
        "rockshape summarise upstream.csv downstream.csv --group table --compare --json",
    )
    parser.add_argument(
        "tables",
        type=Path,
        nargs="+",
        metavar="TABLE",
        help="tables of rockshape measure, .csv, .json or .parquet; several are taken together",
    )
    parser.add_argument(
        "--size",
        metavar="COLUMN",
        help="column of sizes (default: the first with values of minor_axis_mm, feret_min_mm, "
        "axis_b_m, minor_axis_px, feret_min_px); half-axes are doubled",
    )
    parser.add_argument(
        "--least",
        type=float,
        metavar="SIZE",
        help="smallest size that counts, in the column's mm or px",
    )
    parser.add_argument(
        "--cut",
        action="store_true",
        help="count rocks that the frame cuts too, by what is in sight",
    )
    parser.add_argument(
        "--group",
        metavar="COLUMN",
        help="summarise each value of a column by itself: table (the file), image, site, ...",
    )
    parser.add_argument(
        "--compare", action="store_true", help="compare the two groups, or the two tables"
    )
    parser.add_argument(
        "--area",
        type=float,
        metavar="M2",
        help="ground that the rocks lie on, m²: adds their abundance and a Golombek-Rapp fit; with "
        "--cut the rocks at the frame count too",
    )
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument(
        "--out", type=Path, metavar="FILE", help="write that to a file, .json or .txt"
    )


def run(args: argparse.Namespace) -> int:
    """Summarise tables."""
    from rockshape.commands.summarise_tables import (  # noqa: PLC0415 - brings pandas
        SummariseOptions,
        summarise_tables,
    )

    names = SummariseOptions.__dataclass_fields__
    summarise_tables(SummariseOptions(**{name: getattr(args, name) for name in names}))
    return 0
