"""Page of a run: one HTML file that needs nothing else."""

from importlib.resources import files

from markupsafe import Markup

from validation.execution.run import Run
from validation.report.charts import mark_symbols
from validation.report.leaderboard import leaderboards
from validation.report.page_selection import choose
from validation.report.provenance import seeds, versions
from validation.report.section import Room, page_of
from validation.report.template import render
from validation.scores.scoring import all_claims
from validation.suite.gates import tally

MAX_BYTES = 5_000_000  # of the page
SHARES = (1.0, 0.6, 0.3, 0.1, 0.0)  # of the room below, tried one after another until it fits
_ROCKS_BYTES = 3_000_000  # of rocks one by one
_POINTS = 6_000  # of all charts
_MIN_POINTS = 40  # of a chart


def _resource(name: str) -> Markup:
    return Markup((files("validation.report") / name).read_text(encoding="utf-8"))


def page_html(run: Run, *, command: str, seconds: float) -> str:
    """Page of a run, its style, script and pictures inside; as much as fits 5 MB."""
    html = ""
    for share in SHARES:
        html = _page(run, share, command=command, seconds=seconds)
        if len(html.encode()) <= MAX_BYTES:
            break
    return html


def _page(run: Run, share: float, *, command: str, seconds: float) -> str:
    points = share * _POINTS / max(1, len(all_claims(run.suite)))
    room = Room(
        chosen=choose(run, share * _ROCKS_BYTES),
        most_points=max(_MIN_POINTS, int(points)),
        share=share,
    )
    sections = [(e.name, page_of(e).section(run, e, room)) for e in run.suite.experiments]
    return render(
        "page.html",
        run=run,
        style=_resource("page.css") + _resource("rocks.css"),
        script=_resource("page.js"),
        marks=mark_symbols(),
        tally=tally(run.gates),
        passed=[gate for gate in run.gates if gate.passed],
        failed=[gate for gate in run.gates if not gate.passed],
        scores={score.name: score for score in run.scores},
        sections=[(name, section) for name, section in sections if section],
        boards=leaderboards(run),
        command=command,
        minutes=f"{seconds:.0f} s",
        versions=versions(),
        seeds=seeds(run),
    )
