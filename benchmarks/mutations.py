"""The mutation table: each error put in on purpose, and the gates that caught it."""

import argparse
import sys

from validation.mutations import MUTATIONS, prepare_bench
from validation.suite import load_suite


def main() -> int:
    """Print the table as Markdown; return 1 where a mutation or a gate went without the other."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--suite", default="ci")
    parser.add_argument("--scenes", type=int, default=9999, help="of each experiment, at most")
    args = parser.parse_args()
    bench = prepare_bench(load_suite(args.suite), scenes=args.scenes)
    control = bench.failing(bench.records)
    print("without any, these gates fail:", ", ".join(control) or "none", file=sys.stderr)
    bitten: set[str] = set()
    missed = []
    print("| mutation | what is wrong | gates that caught it |\n| --- | --- | --- |")
    for mutation in MUTATIONS:
        caught = bench.catch(mutation)
        new = [gate for gate in caught.gates if gate not in control]
        bitten |= set(new)
        missed += [] if new else [mutation.name]
        told = ", ".join(f"`{gate}`" for gate in new) or "**none**"
        print(f"| {mutation.name} | {mutation.what} | {told} |", flush=True)
    every = {f"{g.score} {g.relation} {g.bound:g}" for g in bench.suite.gates}
    idle = sorted(every - bitten - set(control))
    print(
        f"\n{len(MUTATIONS) - len(missed)} of {len(MUTATIONS)} caught; gates that caught none: "
        f"{', '.join(idle) or 'none'}"
    )
    return int(bool(missed or idle or control))


if __name__ == "__main__":
    sys.exit(main())
