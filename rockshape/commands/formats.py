"""`rockshape formats`: the known file formats of each kind."""

import argparse
from collections.abc import Iterator

from rockshape.commands.parser import examples

HELP = "list the file formats that can be read and written"
KINDS = ("image", "labels", "range", "camera", "table")
HEADINGS = ("format", "suffixes", "access", "content")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.epilog = examples("rockshape formats", "rockshape formats range")
    parser.add_argument(
        "kind",
        nargs="?",
        choices=KINDS,
        metavar="KIND",
        help=f"one kind of file: {', '.join(KINDS)} (default: all)",
    )


def run(args: argparse.Namespace) -> int:
    """Print a table of the formats for each kind."""
    print("\n\n".join(_table(kind) for kind in KINDS if args.kind in (None, kind)))
    return 0


def _table(kind: str) -> str:
    """Aligned table of one kind's formats, under the kind's name."""
    rows = [HEADINGS, *_rows(kind)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
    return "\n".join([kind, *(f"  {line}" for line in lines)])


def _rows(kind: str) -> Iterator[tuple[str, ...]]:
    from rockshape.io.registry import known_formats  # noqa: PLC0415 - brings NumPy and OpenCV

    for each in known_formats():
        if each.kind == kind:
            yield (
                each.name,
                " ".join(each.suffixes) or "folder",
                each.access,
                each.summary.replace("`", ""),
            )
