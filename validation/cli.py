"""The sub-command `rockshape validate`."""

import argparse
import shlex
import sys
import time
from pathlib import Path
from typing import NoReturn

from tqdm import tqdm

from validation.gates import check_names
from validation.report import check_target, write_run
from validation.report.words import number
from validation.run import Run, default_jobs, run_suite
from validation.scores import definitions
from validation.suite import load_gates, load_suite, suite_names
from validation.units import Unit, describe, units_of

HELP = "Hold the measures to rocks of known shape and pass a verdict."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the actions and their arguments."""
    actions = parser.add_subparsers(title="actions", metavar="ACTION", required=True)
    about = "Run a suite: make its scenes, measure them, score, gate and report."
    run_parser = actions.add_parser("run", help=about, description=about)
    run_parser.add_argument(
        "--suite",
        default="ci",
        metavar="NAME|FILE.toml",
        help=f"one of {', '.join(suite_names())}, or a file (default: ci)",
    )
    run_parser.add_argument(
        "--out",
        type=Path,
        metavar="DIR",
        help="folder for the report (default: reports/ and the suite's name)",
    )
    run_parser.add_argument(
        "--jobs",
        type=int,
        default=default_jobs(),
        metavar="N",
        help="processes (default: one a processor, here %(default)s)",
    )
    run_parser.add_argument(
        "--gates",
        type=Path,
        metavar="FILE.toml",
        help="gates to use in place of the suite's own",
    )


class _Progress:
    """A bar on a terminal, one plain line a unit elsewhere."""

    def __init__(self, total: int) -> None:
        self._bar: tqdm[NoReturn] = tqdm(total=total, unit="unit", disable=None, file=sys.stderr)
        self._total = total
        self._done = 0

    def advance(self, unit: Unit) -> None:
        """Count one unit as done."""
        self._done += 1
        if self._bar.disable:
            print(f"[{self._done}/{self._total}] {describe(unit)}", file=sys.stderr, flush=True)
            return
        self._bar.set_description(describe(unit))
        self._bar.update()

    def close(self) -> None:
        """Leave the terminal tidy."""
        self._bar.close()


def _command(args: argparse.Namespace) -> str:
    gates = ["--gates", str(args.gates)] if args.gates else []
    return shlex.join(
        ["rockshape", "validate", "run", "--suite", args.suite, *gates, "--jobs", str(args.jobs)]
    )


def _print_verdict(run: Run, out: Path, seconds: float) -> None:
    for result in run.gates:
        if not result.passed:
            gate = result.gate
            print(
                f"gate failed: {gate.score} expected {gate.relation} {number(gate.bound)}, "
                f"found {number(result.found)}: {gate.reason}"
            )
    for check in run.checks:
        if not check.sound:
            verdict = "does not pass every gate" if check.knows else "passes every gate"
            print(f"warning: fed with {check.fed}, the suite {verdict}", file=sys.stderr)
    passed = sum(result.passed for result in run.gates)
    verdict = "passed" if run.passed else "FAILED"
    print(f"{verdict}: {passed} of {len(run.gates)} gates in {seconds:.0f} s; {out / 'index.html'}")


def run(args: argparse.Namespace) -> int:
    """Run a suite; return 0 when every gate passed, else 1.

    Raises:
        InputError: a suite, gates, a number of jobs or a folder that cannot be used.
    """
    suite = load_suite(args.suite)
    gates = load_gates(args.gates) if args.gates else suite.gates
    known = {definition.name for definition in definitions(suite)}
    check_names(gates, known, where=str(args.gates or f"suite {suite.name}"))
    out = args.out or Path("reports") / suite.name
    check_target(out)
    start = time.monotonic()
    progress = _Progress(len(units_of(suite)))
    try:
        outcome = run_suite(suite, gates=gates, jobs=args.jobs, on_done=progress.advance)
    finally:
        progress.close()
    seconds = time.monotonic() - start
    write_run(outcome, out, command=_command(args), seconds=seconds)
    _print_verdict(outcome, out, seconds)
    return 0 if outcome.passed else 1
