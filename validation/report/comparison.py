"""A comparison of two runs in Markdown, short enough for a terminal or a pull request."""

from collections.abc import Sequence

from validation.execution.compare import REGRESSIONS, Change
from validation.report.format import interval, number

_TOLD = ("worse", "gone", "better", "moved")


def comparison_markdown(changes: Sequence[Change], fallen: Sequence[str]) -> str:
    """Verdict, the gates that fell and what moved; the rest is only counted."""
    counts = dict.fromkeys((*_TOLD, "new", "same"), 0)
    for change in changes:
        counts[change.verdict] += 1
    bad = bool(fallen) or any(counts[verdict] for verdict in REGRESSIONS)
    told = ", ".join(f"{count} {verdict}" for verdict, count in counts.items() if count)
    lines = [f"**{'WORSE' if bad else 'no worse'}**: of {len(changes)} scores {told}"]
    lines += [f"- gate passed before and fails now: `{name}`" for name in fallen]
    moved = [change for verdict in _TOLD for change in changes if change.verdict == verdict]
    if moved:
        lines += ["", "| | score | old | new | interval of the difference |"]
        lines += ["| --- | --- | --- | --- | --- |"]
    lines += [
        f"| {change.verdict} | `{change.name}` | {number(change.old)} | {number(change.new)} "
        f"| {interval(change.low, change.high)} |"
        for change in moved
    ]
    if moved:
        lines += ["", "Intervals, paired by rock, hold for all scores together at 95 %."]
    return "\n".join(lines) + "\n"
