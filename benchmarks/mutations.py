"""The mutation table: each error put in on purpose, and the gates that caught it."""

import argparse
import sys

from validation.mutations import MUTATIONS, prepare_bench
from validation.suite.suite import Suite, load_suite


def table(suite: Suite, method: str, *, scenes: int) -> bool:
    """Print a method's table as Markdown; tell whether mutations and gates all met."""
    bench = prepare_bench(suite, scenes=scenes, method=method)
    control = bench.failing(bench.records)
    print(f"{method}: without any, these gates fail: {', '.join(control) or 'none'}\n")
    bitten: set[str] = set()
    missed = []
    print("| mutation | what is wrong | gates that caught it |\n| --- | --- | --- |")
    for mutation in MUTATIONS[method]:
        caught = bench.catch(mutation)
        new = [gate for gate in caught.gates if gate not in control]
        bitten |= set(new)
        missed += [] if new else [mutation.name]
        told = ", ".join(f"`{gate}`" for gate in new) or "**none**"
        print(f"| {mutation.name} | {mutation.what} | {told} |", flush=True)
    every = {f"{g.score} {g.relation} {g.bound:g}" for g in bench.suite.gates}
    idle = sorted(every - bitten - set(control))
    count = len(MUTATIONS[method])
    print(
        f"\n{count - len(missed)} of {count} caught; gates that caught none: "
        f"{', '.join(idle) or 'none'}\n"
    )
    return not (missed or idle or control)


def main() -> int:
    """Print the tables; return 1 where a mutation or a gate went without the other."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--suite", default="ci")
    parser.add_argument("--scenes", type=int, default=9999, help="of each experiment, at most")
    args = parser.parse_args()
    suite = load_suite(args.suite)
    whole = [table(suite, method, scenes=args.scenes) for method in MUTATIONS]
    return int(not all(whole))


if __name__ == "__main__":
    sys.exit(main())
