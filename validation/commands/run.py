"""Action `run`: a suite run, written and told."""

import argparse
import shlex
import signal
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import NoReturn

import msgspec

from rockshape.execution.executors import cluster, default_jobs, local
from rockshape.execution.progress import Progress
from validation.errors import InputError, Terminated
from validation.execution.run import Run, prepare, run_suite
from validation.execution.run_lock import run_lock
from validation.execution.store import FOLDER, UnitStore, unit_key
from validation.execution.units import describe, units_of
from validation.peers.function_process import end_functions
from validation.peers.parse import parse_measure, parse_traits, settle
from validation.report import check_target, write_run
from validation.report.format import number
from validation.report.leaderboard import leaderboard_lines
from validation.scores.scoring import score_names
from validation.suite.gates import check_names, gates_on, tally
from validation.suite.methods import with_methods
from validation.suite.suite import Suite, load_gates, load_suite


def _command(args: argparse.Namespace, jobs: int) -> str:
    words = ["rockshape", "validate", "run", "--suite", args.suite]
    words += [word for method in args.method or () for word in ("--method", method)]
    words += ["--gates", str(args.gates)] if args.gates else []
    for option, values in (("--measure", args.measure), ("--expected-trait", args.expected_trait)):
        words += [word for value in values for word in (option, value)]
    return shlex.join([*words, "--jobs", str(jobs)])


def _with_measures(suite: Suite, args: argparse.Namespace) -> Suite:
    """Suite with the measures of the command line, each tried once."""
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
    verdict = "passed" if run.passed else "FAILED"
    print(f"{verdict}: {tally(run.gates)} in {seconds:.0f} s; {out / 'index.html'}")


@contextmanager
def _unwound_by_sigterm() -> Iterator[None]:
    """Let SIGTERM end the run as an interrupt does, with its processes and temporary files."""

    def leave(*_: object) -> NoReturn:
        raise Terminated

    if threading.current_thread() is not threading.main_thread():  # only it can set handlers
        yield
        return
    before = signal.signal(signal.SIGTERM, leave)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def run_action(args: argparse.Namespace) -> int:
    """Run a suite, write its report and print the verdict; 1 where a gate failed.

    Raises:
        InputError: a suite, gates, a method, a number of jobs or a folder that cannot be used.
    """
    with _unwound_by_sigterm():
        try:
            return _run(args)
        finally:
            end_functions()


def _run(args: argparse.Namespace) -> int:
    suite = _with_measures(load_suite(args.suite), args)
    gates = load_gates(args.gates) if args.gates else suite.gates
    asked = with_methods(suite, args.method) if args.method else suite
    known = score_names(suite) | score_names(asked)
    check_names(gates, known, where=str(args.gates or f"suite {suite.name}"))
    suite, gates = asked, gates_on(gates, score_names(asked))
    jobs = default_jobs() if args.jobs is None else args.jobs
    out = args.out or Path("reports") / suite.name
    check_target(out)
    place = cluster(args.scheduler) if args.scheduler else local(jobs)
    suite = prepare(suite)
    start = time.monotonic()
    with run_lock(out):
        with ExitStack() as stack:
            executor = stack.enter_context(place)
            store = UnitStore(out / FOLDER, keep=args.resume)
            units = units_of(suite)
            progress = stack.enter_context(
                closing(
                    Progress(
                        len(units), sum(store.has(unit_key(unit)) for unit in units), unit="unit"
                    )
                )
            )
            outcome = run_suite(
                suite,
                gates=gates,
                executor=executor,
                store=store,
                on_done=lambda unit: progress.advance(describe(unit)),
            )
        seconds = time.monotonic() - start
        write_run(outcome, out, command=_command(args, jobs), seconds=seconds)
    _print_verdict(outcome, out, seconds)
    return 0 if outcome.passed else 1
