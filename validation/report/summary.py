"""A run in Markdown, short enough for a pull request."""

from validation.execution.run import Run
from validation.report.format import interval, number
from validation.report.leaderboard import leaderboard_lines
from validation.suite.gates import Gate, tally


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")


def _bound(gate: Gate) -> str:
    end = "" if gate.end == "value" else f" ({gate.end} end)"
    return f"{gate.relation} {number(gate.bound)}{end}"


def summary_markdown(run: Run) -> str:
    """Verdict, the gates and the scores as Markdown tables."""
    verdict = "passed" if run.passed else "FAILED"
    lines = [
        f"# {run.suite.title}",
        "",
        f"**{verdict}**: {tally(run.gates)}"
        + (f", rendered with {run.backend}." if run.backend else "."),
        "",
        "| gate | bound | found | | reason |",
        "| --- | --- | --- | --- | --- |",
    ]
    lines += [
        f"| `{g.gate.score}` | {_bound(g.gate)} | {number(g.found)} "
        f"| {'pass' if g.passed else '**FAIL**'} | {_cell(g.gate.reason)} |"
        for g in run.gates
    ]
    board = leaderboard_lines(run)
    lines += ["", "## Leaderboard", *board] if board else []
    lines += [
        "",
        "## Scores",
        "",
        "| score | value | 95 % interval | unit | count |",
        "| --- | --- | --- | --- | --- |",
    ]
    lines += [
        f"| `{s.name}` | {number(s.value)} | {interval(s.low, s.high)} | {s.unit} "
        f"| {s.count} {s.counted} |"
        for s in run.scores
    ]
    if run.checks:
        fed = "; ".join(f"{check.fed}: {len(check.passes)}" for check in run.checks)
        gates = len(run.checks[0].gates)
        lines += ["", f"Self-check, gates passed of {gates} when fed with … {fed}."]
    lines.append("")
    return "\n".join(lines)
