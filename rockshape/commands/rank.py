"""`rockshape rank`: the command's arguments."""

import argparse
import sys
from pathlib import Path

from rockshape.commands.counted import counted
from rockshape.commands.parser import examples

HELP = "order rocks by a value, with the probability of each order"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.epilog = examples(
        "rockshape rank rocks.csv --by angularity_2d --top 5",
        "rockshape rank sol1.parquet sol2.parquet --by roundness --ascending --json",
    )
    parser.add_argument(
        "tables",
        type=Path,
        nargs="+",
        metavar="TABLE",
        help="tables of rockshape measure --uncertainty, .csv, .json or .parquet; several are "
        "taken together",
    )
    parser.add_argument("--by", required=True, metavar="COLUMN", help="value to order by")
    parser.add_argument("--ascending", action="store_true", help="the lowest value first")
    parser.add_argument("--top", type=int, metavar="N", help="the first N alone")
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument(
        "--out", type=Path, metavar="FILE", help="write the table, .csv, .json or .parquet"
    )


def run(args: argparse.Namespace) -> int:
    """Print or write the ranking."""
    from rockshape.commands.tables import joined  # noqa: PLC0415 - with what follows, pandas
    from rockshape.errors import InputError  # noqa: PLC0415
    from rockshape.io.tables.json import encode_json  # noqa: PLC0415
    from rockshape.io.writers import write_table  # noqa: PLC0415
    from rockshape.ranking import rank  # noqa: PLC0415

    if args.top is not None and args.top < 1:
        raise InputError(f"--top: expected 1 or more, found {args.top}")
    table = joined(args.tables)
    if len(args.tables) == 1:
        table = table.drop(columns="table")
    ranked = rank(table, args.by, ascending=args.ascending)
    lacking = len(table) - len(ranked)
    if args.top is not None:
        ranked = ranked.head(args.top)
    if args.out is not None:
        write_table(args.out, ranked)
    elif args.json:
        print(encode_json(ranked).decode())
    else:
        print(ranked.to_csv(index=False, float_format="%.4g"), end="")
    if lacking:
        print(
            f"{counted(lacking, 'rock')} without {args.by} or its uncertainty left out",
            file=sys.stderr,
        )
    return 0
