"""Run benchmark cases and keep their figures in benchmarks/results.json.

    python benchmarks/run.py --list
    python benchmarks/run.py flat_speed ellipsoid
    python benchmarks/run.py --smallest --jobs 2

Without CASE all but the slow cases run. A case at its smallest size tests that it works: its
figures are printed, and kept only where --out names a file; several cases may then run side by
side, which full ones never do. `tables.py` writes the tables in docs.
"""

import argparse
import difflib
import importlib
import os
import pkgutil
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import cv2
from case import Case
from results import RESULTS, entry_of, save_entry
from tables import markdown
from threadpoolctl import threadpool_limits

THREAD_VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def all_cases() -> dict[str, Case]:
    """Return the cases of all files in cases/, by name."""
    folder = Path(__file__).parent / "cases"
    modules = [
        importlib.import_module(f"cases.{info.name}") for info in pkgutil.iter_modules([folder])
    ]
    found = [
        value for module in modules for value in vars(module).values() if isinstance(value, Case)
    ]
    return {case.name: case for case in sorted(found, key=lambda case: case.name)}


def find_case(name: str, cases: dict[str, Case]) -> Case:
    """Return a case by its name."""
    if name in cases:
        return cases[name]
    near = difflib.get_close_matches(name, cases, n=1)
    hint = f"; did you mean '{near[0]}'?" if near else "; --list names them"
    raise SystemExit(f"benchmarks: unknown case '{name}'{hint}")


def run_case(case: Case, *, smallest: bool, out: Path | None) -> None:
    """Run a case, print its tables and keep them where asked."""
    size = "smallest" if smallest else "full"
    start, load = time.perf_counter(), os.getloadavg()[0]
    os.environ.update(dict.fromkeys(THREAD_VARIABLES, str(case.threads)))  # of its children
    cv2.setNumThreads(case.threads)
    with threadpool_limits(case.threads):
        tables = list(case.run(**(case.smallest if smallest else {})))
    entry = entry_of(case, size, tables, load=max(load, os.getloadavg()[0]))
    if out is not None:
        save_entry(case.name, entry, out)
    head = f"\n{case.name} ({size}, {time.perf_counter() - start:.1f} s): {case.what}\n"
    told = [f"{table['name']}\n{markdown(table)}".lstrip("\n") for table in entry["tables"]]
    print("\n\n".join([head.rstrip("\n"), *told]), flush=True)


def run_smallest(name: str) -> None:
    """Run a case at its smallest size, by its name, and print its tables."""
    run_case(all_cases()[name], smallest=True, out=None)


def run_side_by_side(chosen: list[Case], jobs: int) -> None:
    """Run cases at their smallest size, so many at a time."""
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        list(pool.map(run_smallest, [case.name for case in chosen]))


def main(argv: list[str] | None = None) -> int:
    """Run what the command line asks for."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("cases", nargs="*", metavar="CASE")
    parser.add_argument("--list", action="store_true", help="name the cases and stop")
    parser.add_argument("--smallest", action="store_true", help="each at its smallest size")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="with --smallest alone")
    parser.add_argument("--out", type=Path, metavar="FILE", help="default: benchmarks/results.json")
    args = parser.parse_args(argv)
    if args.jobs > 1 and (args.out or not args.smallest):
        parser.error("--jobs: expected --smallest without --out beside it: times need the machine")
    cases = all_cases()
    if args.list:
        for case in cases.values():
            print(f"{case.name:22s}{'slow  ' if case.slow else '      '}{case.what}")
        return 0
    try:
        chosen = [find_case(name, cases) for name in args.cases]
    except SystemExit as error:
        print(error, file=sys.stderr)
        return 2
    if not chosen:
        chosen = [case for case in cases.values() if args.smallest or not case.slow]
    if args.jobs > 1:
        run_side_by_side(chosen, args.jobs)
        return 0
    for case in chosen:
        out = args.out or (None if args.smallest else RESULTS)
        run_case(case, smallest=args.smallest, out=out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
