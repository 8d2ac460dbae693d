"""`rockshape synth shapes`: series of drawn shapes from the command line.

What draws them is imported when it is asked for, so that `--help` is fast.
"""

import argparse
from pathlib import Path
from typing import Any

from synth.commands.arguments import listed
from synth.errors import SpecError
from synth.spec.shapes import JITTER_RMS_PX, SERIES_NAMES

_EXAMPLES = """examples:
  rockshape synth shapes shapes --series roundness --count 4 --seed 1
  rockshape synth shapes uneven --series both --knobs 0.1,0.2,0.7
"""


def add_shapes_arguments(kinds: Any) -> None:
    """Declare the kind `shapes` among the kinds of output."""
    shapes: argparse.ArgumentParser = kinds.add_parser(
        "shapes",
        help="a series of drawn shapes: image, labels and ground truth",
        description="Draw a series of shapes whose outlines are known exactly.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    shapes.add_argument("out", metavar="OUT", type=Path, help="folder of the drawing")
    shapes.add_argument("--series", metavar="NAME", required=True, help=listed(SERIES_NAMES))
    shapes.add_argument("--count", metavar="N", type=int, help="number of shapes (default 4)")
    shapes.add_argument("--size", metavar="PX", type=float, help="long side of every shape")
    shapes.add_argument(
        "--turn", metavar="DEG", type=float, default=0.0, help="anticlockwise turn (default 0)"
    )
    shapes.add_argument(
        "--knobs", metavar="V,V,…", help="values of the series' parameter, in place of even steps"
    )
    shapes.add_argument(
        "--jitter",
        metavar="PX",
        type=float,
        default=JITTER_RMS_PX,
        help=f"RMS jitter of the pen, px (default {JITTER_RMS_PX:g})",
    )
    shapes.add_argument("--seed", metavar="N", type=int, default=0, help="random seed (default 0)")


def run_shapes(args: argparse.Namespace) -> int:
    """Draw the series and return 0.

    Raises:
        SpecError: an argument that cannot be used.
    """
    from synth.shapes.write import write_series  # noqa: PLC0415

    if args.seed < 0:
        raise SpecError(f"--seed: expected 0 or more, found {args.seed}")
    try:
        write_series(
            args.series,
            args.out,
            count=args.count,
            knobs=_numbers("--knobs", args.knobs),
            seed=args.seed,
            jitter_rms_px=args.jitter,
            size_px=args.size,
            turn_deg=args.turn,
        )
    except SpecError as error:
        raise SpecError(_named_as_option(str(error))) from error
    return 0


def _named_as_option(text: str) -> str:
    """Complaint about an argument of `write_series` with the option's name."""
    name, _, rest = text.partition(":")
    options = {
        "series": "series",
        "count": "count",
        "knobs": "knobs",
        "jitter_rms_px": "jitter",
        "size_px": "size",
        "turn_deg": "turn",
    }
    return f"--{options[name]}:{rest}" if name in options else text


def _numbers(option: str, text: str | None) -> list[float] | None:
    """Comma-separated numbers, None where the option was not given."""
    if text is None:
        return None
    try:
        return [float(part) for part in text.split(",")]
    except ValueError as error:
        raise SpecError(f"{option}: expected comma-separated numbers, found {text!r}") from error
