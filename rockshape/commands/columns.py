"""`rockshape columns`: unit and meaning of each column of the table."""

import argparse

from rockshape.commands.parser import examples

HELP = "list the columns of the table of rocks with their units"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.epilog = examples("rockshape columns", "rockshape columns --method paper --json-schema")
    parser.add_argument(
        "--method",
        default="robust",
        metavar="NAME",
        help="whose measures are listed: robust (default), paper, or one that a plug-in adds",
    )
    parser.add_argument(
        "--json-schema",
        action="store_true",
        help="print the JSON Schema of a table with all columns",
    )


def run(args: argparse.Namespace) -> int:
    """Print the columns of a method's table."""
    import json  # noqa: PLC0415 - with what follows, half a second

    from rockshape.measurement import columns  # noqa: PLC0415
    from rockshape.method import find_method  # noqa: PLC0415
    from rockshape.table.columns import described, json_schema  # noqa: PLC0415

    every = columns(args.method, descriptors=True, flags=True, sizes=True, uncertainty=True)
    names = ("image", *every)
    told = described(names, find_method(args.method).measures)
    if args.json_schema:
        print(json.dumps(json_schema(told), indent=1, ensure_ascii=False))
        return 0
    widths = [max(len(getattr(each, name)) for each in told) for name in ("name", "unit")]
    for each in told:
        print(f"{each.name:{widths[0]}}  {each.unit:{widths[1]}}  {each.description}".rstrip())
    return 0
