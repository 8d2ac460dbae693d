"""Action `compare`: the comparison of two runs in Markdown."""

import argparse

from validation.errors import InputError
from validation.execution.compare import MARGIN, REGRESSIONS, compare
from validation.execution.recorded import check_paired, failed_gates, load_recorded
from validation.report.comparison import comparison_markdown


def compare_action(args: argparse.Namespace) -> int:
    """Print the comparison; 1 where a score got worse or a gate fell.

    Raises:
        InputError: a folder that holds no run, or runs that do not show the same rocks.
    """
    margin = MARGIN if args.margin is None else args.margin
    if not margin >= 0:
        raise InputError(f"--margin: expected a number from 0, found {margin}")
    old, new = load_recorded(args.old), load_recorded(args.new)
    try:
        check_paired(old, new)
        changes = compare(old, new, margin=margin)
    except InputError:
        raise
    except Exception as error:  # of records with values that no run writes
        raise InputError(
            f"{args.new}: expected records that can be scored beside those of {args.old}, "
            f"found {type(error).__name__}: {error}"
        ) from error
    fallen = failed_gates(old, new)
    print(comparison_markdown(changes, fallen), end="")
    return int(bool(fallen) or any(change.verdict in REGRESSIONS for change in changes))
