"""`rockshape validate`: suites run against rocks of known shape, and runs compared.

What does the work is imported when it is asked for, so that `--help` is fast.
"""

import argparse
from pathlib import Path

from validation.suite.shipped import suite_names

HELP = "score the measures against rocks of known shape, and hold the scores to gates"

_EXAMPLES = """examples:
  rockshape validate run --suite ci --out reports/ci
  rockshape validate compare reports/baseline reports/ci
"""
_RUN_EXAMPLES = """examples:
  rockshape validate run --suite ci --jobs 2 --out reports/ci
  rockshape validate run --suite mine.toml --measure mine=package.module:roundness
"""
_COMPARE_EXAMPLES = """examples:
  rockshape validate compare reports/baseline reports/ci
  rockshape validate compare before after --margin 0.01
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the actions and their arguments."""
    parser.epilog, parser.formatter_class = _EXAMPLES, argparse.RawDescriptionHelpFormatter
    actions = parser.add_subparsers(title="actions", metavar="ACTION", required=True)
    _add_run(
        actions.add_parser(
            "run",
            help="run a suite: render its scenes, measure them, score, gate and report",
            description="Run a suite: render its scenes, measure them, score, gate and report.",
            epilog=_RUN_EXAMPLES,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
    )
    _add_compare(
        actions.add_parser(
            "compare",
            help="compare two runs of a suite, paired rock by rock",
            description="Compare two runs of a suite, paired rock by rock. Exit status 1 where a "
            "score got worse or a gate fell.",
            epilog=_COMPARE_EXAMPLES,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
    )


def _add_run(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--suite",
        default="ci",
        metavar="NAME|FILE.toml",
        help=f"one of {', '.join(suite_names())}, or a file (default: ci)",
    )
    parser.add_argument(
        "--out",
        type=Path,
        metavar="DIR",
        help="folder of the report (default: reports/ and the suite's name)",
    )
    parser.add_argument(
        "--jobs", type=int, metavar="N", help="worker processes (default: one per processor)"
    )
    parser.add_argument(
        "--method",
        action="append",
        metavar="NAME|MODULE:NAME",
        help="measure with this method alone, or with a Method record of a module, and hold the "
        "gates on it; may be repeated (default: the suite's methods)",
    )
    parser.add_argument(
        "--gates",
        type=Path,
        metavar="FILE.toml",
        help="gates to use in place of the suite's own",
    )
    parser.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="run on the Dask cluster of this scheduler, such as tcp://host:8786, instead of here",
    )
    parser.add_argument(
        "--resume",
        action="store_true",
        help="keep the results of an earlier run in --out that the same code measured",
    )
    parser.add_argument(
        "--measure",
        action="append",
        default=[],
        metavar="[NAME=]MEASURE",
        help="judge this measure too: package.module:function, a command with {image} {labels} "
        "{range} {out}, or a peer package such as scikit-image; may be repeated",
    )
    parser.add_argument(
        "--expected-trait",
        "--rises-with",
        action="append",
        default=[],
        metavar="COLUMN=TRAIT",
        help="trait that a column of --measure should rise with: angularity, roundness, "
        "roughness or form",
    )
    parser.set_defaults(action=_run)


def _add_compare(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("old", type=Path, metavar="OLD", help="folder of the earlier run")
    parser.add_argument("new", type=Path, metavar="NEW", help="folder of the later run")
    parser.add_argument(
        "--margin",
        type=float,
        metavar="X",
        help="largest difference that counts as none (default: what another renderer changes)",
    )
    parser.set_defaults(action=_compare)


def run(args: argparse.Namespace) -> int:
    """Run or compare; return 0 when all is well, 1 when a gate failed or a score got worse.

    Raises:
        InputError: a suite, gates, a number of jobs, a folder or a run that cannot be used.
    """
    status: int = args.action(args)
    return status


def _run(args: argparse.Namespace) -> int:
    from validation.commands.run import run_action  # noqa: PLC0415

    return run_action(args)


def _compare(args: argparse.Namespace) -> int:
    from validation.commands.compare import compare_action  # noqa: PLC0415

    return compare_action(args)
