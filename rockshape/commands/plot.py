"""`rockshape plot`: grain-size curves and forms of the rocks in tables."""

import argparse
from pathlib import Path

from rockshape.commands.parser import examples

HELP = "plot size curves, form and roundness of the rocks in tables"
SUFFIXES = (".svg", ".png", ".pdf")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.epilog = examples(
        "rockshape plot grains.csv --out grains.svg",
        "rockshape plot upstream.csv downstream.csv --group table --by area --out both.png",
    )
    parser.add_argument(
        "tables",
        type=Path,
        nargs="+",
        metavar="TABLE",
        help="tables of rockshape measure, .csv, .json or .parquet",
    )
    parser.add_argument(
        "--out", type=Path, required=True, metavar="FILE", help="picture: .svg, .png or .pdf"
    )
    parser.add_argument("--size", metavar="COLUMN", help="column of sizes, as in summarise")
    parser.add_argument(
        "--by",
        choices=("number", "area", "weight"),
        default="number",
        help="what the percent are of (default: number)",
    )
    parser.add_argument("--group", metavar="COLUMN", help="a curve for each value of a column")
    parser.add_argument("--cut", action="store_true", help="count rocks that the frame cuts too")


def run(args: argparse.Namespace) -> int:
    """Plot tables."""
    import io  # noqa: PLC0415 - what follows brings pandas and Matplotlib

    from rockshape.commands.tables import groups, joined  # noqa: PLC0415
    from rockshape.errors import InputError  # noqa: PLC0415
    from rockshape.io.files import check_writable, write_bytes  # noqa: PLC0415
    from rockshape.samples.plot import plot_samples  # noqa: PLC0415
    from rockshape.samples.sample import sample_of  # noqa: PLC0415
    from rockshape.samples.size_column import size_column  # noqa: PLC0415
    from rockshape.samples.weighting import WEIGHTINGS  # noqa: PLC0415

    check_writable(args.out, suffixes=SUFFIXES)
    table = joined(args.tables)
    column = size_column(table, args.size)
    samples = {
        name: sample_of(part, column, cut=args.cut)
        for name, part in groups(table, args.group).items()
    }
    if not any(len(sample) for sample in samples.values()):
        raise InputError("tables: expected rocks that count, found none")
    content = io.BytesIO()
    figure = plot_samples(samples, WEIGHTINGS[args.by])
    figure.savefig(content, format=args.out.suffix[1:].lower(), dpi=150)
    write_bytes(args.out, content.getvalue())
    return 0
