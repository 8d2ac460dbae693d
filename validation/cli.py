"""The sub-command `rockshape validate`."""

import argparse
import shlex
import sys
import time
from contextlib import ExitStack, closing
from pathlib import Path
from typing import NoReturn, get_args

import msgspec
from tqdm import tqdm

from rockshape.method import methods
from validation.errors import InputError
from validation.execution.compare import MARGIN, REGRESSIONS, compare
from validation.execution.executors import cluster, default_jobs, local
from validation.execution.recorded import check_paired, failed_gates, load_recorded
from validation.execution.run import Run, prepare, run_suite
from validation.execution.store import FOLDER, UnitStore, unit_key
from validation.execution.units import AnyUnit, describe, units_of
from validation.peers import Trait
from validation.peers.adapters import ADAPTERS
from validation.peers.parse import parse_measure, parse_traits, settle
from validation.report import check_target, write_run
from validation.report.comparison import comparison_markdown
from validation.report.format import number
from validation.report.leaderboard import leaderboard_lines
from validation.scores.scoring import score_names
from validation.suite.gates import check_names, gates_on
from validation.suite.suite import Suite, load_gates, load_suite, suite_names, with_methods

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
        "--method",
        action="append",
        choices=tuple(methods()),
        help="measure by this method alone, and hold the gates on it; may be repeated "
        "(default: as the suite says)",
    )
    run_parser.add_argument(
        "--gates",
        type=Path,
        metavar="FILE.toml",
        help="gates to use in place of the suite's own",
    )
    run_parser.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="run on the Dask cluster of this scheduler, as tcp://host:8786, instead of here",
    )
    run_parser.add_argument(
        "--resume",
        action="store_true",
        help="keep what an earlier run in --out has measured with this very code",
    )
    run_parser.add_argument(
        "--measure",
        action="append",
        default=[],
        metavar="[NAME=]MEASURE",
        help="judge this too: package.module:function, a command with {image} {labels} {range} "
        f"{{out}}, or a peer ({', '.join(ADAPTERS)}); may be repeated",
    )
    run_parser.add_argument(
        "--expected-trait",
        "--rises-with",
        action="append",
        default=[],
        metavar="COLUMN=TRAIT",
        help=f"trait that a column of --measure should rise with: {', '.join(get_args(Trait))}",
    )
    run_parser.set_defaults(action=_run)
    about = "Compare two runs of a suite, rock by rock: what moved, and what got worse."
    compare_parser = actions.add_parser("compare", help=about, description=about)
    compare_parser.add_argument("old", type=Path, metavar="OLD", help="folder of the earlier run")
    compare_parser.add_argument("new", type=Path, metavar="NEW", help="folder of the later run")
    compare_parser.add_argument(
        "--margin",
        type=float,
        default=MARGIN,
        metavar="X",
        help="differences up to this are no news (default: %(default)s)",
    )
    compare_parser.set_defaults(action=_compare)


class _Progress:
    """A bar on a terminal, one plain line a unit elsewhere."""

    def __init__(self, total: int, done: int) -> None:
        self._bar: tqdm[NoReturn] = tqdm(
            total=total, initial=done, unit="unit", disable=None, file=sys.stderr
        )
        self._total = total
        self._done = done
        if done and self._bar.disable:
            print(f"{done} of {total} units are there already", file=sys.stderr, flush=True)

    def advance(self, unit: AnyUnit) -> None:
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
    words = ["rockshape", "validate", "run", "--suite", args.suite]
    words += [word for method in args.method or () for word in ("--method", method)]
    words += ["--gates", str(args.gates)] if args.gates else []
    for option, values in (("--measure", args.measure), ("--expected-trait", args.expected_trait)):
        words += [word for value in values for word in (option, value)]
    return shlex.join([*words, "--jobs", str(args.jobs)])


def _with_measures(suite: Suite, args: argparse.Namespace) -> Suite:
    """Return the suite with the measures of the command line, each tried once."""
    asked = parse_traits(args.expected_trait)
    specs = [settle(spec, {}) for spec in suite.measures]
    specs += [settle(parse_measure(text), asked) for text in args.measure]
    idle = [name for name in asked if not any(name in spec.expected_trait for spec in specs)]
    if idle:
        raise InputError(f"--expected-trait: expected a column of a --measure, found {idle[0]!r}")
    try:
        whole = msgspec.structs.replace(suite, measures=tuple(specs))
        whole.__post_init__()
    except ValueError as error:
        raise InputError(f"--measure: {error}: put NAME= before one") from error
    return whole


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
    if run.suite.measures:
        print("\n".join(leaderboard_lines(run)).strip() + "\n")
    passed = sum(result.passed for result in run.gates)
    verdict = "passed" if run.passed else "FAILED"
    print(f"{verdict}: {passed} of {len(run.gates)} gates in {seconds:.0f} s; {out / 'index.html'}")


def run(args: argparse.Namespace) -> int:
    """Run or compare; return 0 when all is well, 1 when a gate failed or a score got worse.

    Raises:
        InputError: a suite, gates, a number of jobs, a folder or a run that cannot be used.
    """
    status: int = args.action(args)
    return status


def _compare(args: argparse.Namespace) -> int:
    if not args.margin >= 0:
        raise InputError(f"--margin: expected a number from 0, found {args.margin}")
    old, new = load_recorded(args.old), load_recorded(args.new)
    check_paired(old, new)
    changes = compare(old, new, margin=args.margin)
    fallen = failed_gates(old, new)
    print(comparison_markdown(changes, fallen), end="")
    return int(bool(fallen) or any(change.verdict in REGRESSIONS for change in changes))


def _run(args: argparse.Namespace) -> int:
    suite = _with_measures(load_suite(args.suite), args)
    gates = load_gates(args.gates) if args.gates else suite.gates
    asked = with_methods(suite, tuple(dict.fromkeys(args.method))) if args.method else suite
    known = score_names(suite) | score_names(asked)
    check_names(gates, known, where=str(args.gates or f"suite {suite.name}"))
    suite, gates = asked, gates_on(gates, score_names(asked))
    out = args.out or Path("reports") / suite.name
    check_target(out)
    place = cluster(args.scheduler) if args.scheduler else local(args.jobs)
    suite = prepare(suite)
    start = time.monotonic()
    with ExitStack() as stack:
        executor = stack.enter_context(place)
        store = UnitStore(out / FOLDER, keep=args.resume)
        units = units_of(suite)
        progress = stack.enter_context(
            closing(_Progress(len(units), sum(store.has(unit_key(unit)) for unit in units)))
        )
        outcome = run_suite(
            suite, gates=gates, executor=executor, store=store, on_done=progress.advance
        )
    seconds = time.monotonic() - start
    write_run(outcome, out, command=_command(args), seconds=seconds)
    _print_verdict(outcome, out, seconds)
    return 0 if outcome.passed else 1
