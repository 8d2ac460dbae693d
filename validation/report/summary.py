"""A run in Markdown, short enough for a pull request."""

from validation.report.words import interval, number
from validation.run import Run


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")


def summary_markdown(run: Run) -> str:
    """Return the verdict, the gates and the scores as Markdown tables."""
    passed = sum(gate.passed for gate in run.gates)
    verdict = "passed" if run.passed else "FAILED"
    lines = [
        f"# {run.suite.title}",
        "",
        f"**{verdict}**: {passed} of {len(run.gates)} gates passed"
        + (f", rendered with {run.backend}." if run.backend else "."),
        "",
        "| gate | bound | found | | reason |",
        "| --- | --- | --- | --- | --- |",
    ]
    lines += [
        f"| `{g.gate.score}` | {g.gate.relation} {number(g.gate.bound)} | {number(g.found)} "
        f"| {'pass' if g.passed else '**FAIL**'} | {_cell(g.gate.reason)} |"
        for g in run.gates
    ]
    lines += [
        "",
        "| score | value | 95 % interval | unit | count |",
        "| --- | --- | --- | --- | --- |",
    ]
    lines += [
        f"| `{s.name}` | {number(s.value)} | {interval(s.low, s.high)} | {s.unit} "
        f"| {s.count} {s.counted} |"
        for s in run.scores
    ]
    fed = "; ".join(f"{check.fed}: {len(check.passes)}" for check in run.checks)
    lines += ["", f"Self-check, gates passed of {len(run.gates)} when fed with … {fed}.", ""]
    return "\n".join(lines)
