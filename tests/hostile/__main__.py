"""Whole corpus in a pool of processes with limits: `python -m tests.hostile [COUNT] [SEED]`.

A table of outcomes by command and kind is printed and written to reports/hostile; exit status 1
where an outcome is forbidden.
"""

import argparse
import json
import sys
import tempfile
from collections import Counter
from pathlib import Path

from tests.hostile.cases import SIZE, SUITE, Case, cases
from tests.hostile.judge import Verdict
from tests.hostile.pool import judged

ALLOWED = ("done", "refused")


def a_run(folder: Path) -> Path:
    """Small validation run, which comparisons begin with."""
    from validation.api import run

    (folder / "suite.toml").write_bytes(SUITE)
    run(str(folder / "suite.toml"), out=folder / "run", jobs=1)
    return folder / "run"


def table(verdicts: list[tuple[Case, Verdict]]) -> str:
    """Markdown table of outcomes by command and kind."""
    counts = Counter((case.command, case.kind, verdict.outcome) for case, verdict in verdicts)
    outcomes = [*ALLOWED, *sorted({key[2] for key in counts} - set(ALLOWED))]
    lines = [f"| command | kind | {' | '.join(outcomes)} |", "| --- " * (len(outcomes) + 2) + "|"]
    for command, kind in sorted({key[:2] for key in counts}):
        row = " | ".join(str(counts[command, kind, outcome]) for outcome in outcomes)
        lines.append(f"| {command} | {kind} | {row} |")
    total = " | ".join(str(sum(n for k, n in counts.items() if k[2] == o)) for o in outcomes)
    slowest = max(verdicts, key=lambda each: each[1].seconds)
    largest = max(verdicts, key=lambda each: each[1].growth_bytes)
    return "\n".join(
        [
            *lines,
            f"| all | {len(verdicts)} | {total} |",
            "",
            f"slowest {slowest[1].seconds:.1f} s ({slowest[0].name}); most memory "
            f"{largest[1].growth_bytes / 2**20:.0f} MiB ({largest[0].name})",
        ]
    )


def main() -> int:
    """Judge the corpus; 1 where an outcome is forbidden."""
    parser = argparse.ArgumentParser(prog="python -m tests.hostile")
    parser.add_argument("--count", type=int, default=SIZE)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path, default=Path("reports/hostile"))
    args = parser.parse_args()
    out = args.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        verdicts = judged(
            list(cases(args.seed, args.count)), jobs=args.jobs, run=a_run(Path(folder))
        )
    text = table(verdicts)
    print(text)
    (out / "outcomes.md").write_text(text + "\n", encoding="utf-8")
    bad = [each for each in verdicts if each[1].outcome not in ALLOWED]
    for index, (case, verdict) in enumerate(bad):
        print(f"{index}: {verdict.outcome}: {case.command} {case.name}: {verdict.said[-300:]!r}")
        for name, data in case.files.items():
            (out / f"{index}-{Path(name).name}").write_bytes(data)
        (out / f"{index}.json").write_text(
            json.dumps({"argv": case.argv, **verdict._asdict()}, indent=1), encoding="utf-8"
        )
    return int(bool(bad))


if __name__ == "__main__":
    sys.exit(main())
