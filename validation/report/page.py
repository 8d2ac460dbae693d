"""The page: one HTML file that needs nothing else."""

import math
from importlib.resources import files

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from validation.execution.run import Run
from validation.kinds.garden.scores import is_garden
from validation.paper import CONSISTENCY_TABLES
from validation.report.charts import mark_symbols, span, view_key
from validation.report.format import interval, number
from validation.report.garden import garden_tables
from validation.report.leaderboard import leaderboards
from validation.report.page_selection import choose
from validation.report.paper import paper_values
from validation.report.provenance import seeds, versions
from validation.report.sections import (
    Room,
    segmentation_section,
    shapes_section,
    yard_section,
)
from validation.report.sweeps import sweep_section
from validation.scores.agreement import STATISTICS
from validation.scores.expectations import all_claims
from validation.scores.titles import REFERENCE, title_of
from validation.suite.experiments import SegmentationExperiment, ShapesExperiment, YardExperiment

MAX_BYTES = 5_000_000  # of the page
SHARES = (1.0, 0.6, 0.3, 0.1, 0.0)  # of the room below, tried one after another until it fits
_ROCKS_BYTES = 3_000_000  # of rocks one by one
_POINTS = 6_000  # of all charts
_MIN_POINTS = 40  # of a chart


def _breakable(name: str) -> Markup:
    """Return a score's name that a line may break after a dot or an underscore."""
    return Markup(str(escape(name)).replace(".", ".<wbr>").replace("_", "_<wbr>"))


def _resource(name: str) -> Markup:
    return Markup((files("validation.report") / name).read_text(encoding="utf-8"))


def _beside_paper(run: Run, experiment: YardExperiment) -> list[dict[str, object]]:
    """Return one row a statistic: the paper's value and ours for each of its three measures."""
    ours = {score.name: score for score in run.scores}
    paper = paper_values()
    return [
        {
            "title": statistic.title,
            "cells": [
                (
                    paper[measure][statistic.key],
                    ours[f"{experiment.name}.{measure}.{statistic.key}"],
                )
                for measure in CONSISTENCY_TABLES
            ],
        }
        for statistic in STATISTICS
    ]


def page_html(run: Run, *, command: str, seconds: float) -> str:
    """Return the page of a run, its style, script and pictures inside; as much as fits 5 MB."""
    html = ""
    for share in SHARES:
        html = _page(run, share, command=command, seconds=seconds)
        if len(html.encode()) <= MAX_BYTES:
            break
    return html


def _page(run: Run, share: float, *, command: str, seconds: float) -> str:
    environment = Environment(
        loader=PackageLoader("validation.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"number": number, "title_of": title_of, "breakable": _breakable}
    environment.globals |= {
        "interval": interval,
        "view_key": view_key,
        "isfinite": math.isfinite,
        "span": span,
    }
    points = share * _POINTS / max(1, len(all_claims(run.suite)))
    room = Room(
        chosen=choose(run, share * _ROCKS_BYTES),
        most_points=max(_MIN_POINTS, int(points)),
        share=share,
    )
    experiments = run.suite.experiments
    of_rocks = [e for e in experiments if isinstance(e, YardExperiment)]
    yards = [experiment for experiment in of_rocks if experiment.sweep is None]
    html: str = environment.get_template("page.html").render(
        run=run,
        style=_resource("page.css") + _resource("rocks.css"),
        script=_resource("page.js"),
        marks=mark_symbols(),
        passed=[gate for gate in run.gates if gate.passed],
        failed=[gate for gate in run.gates if not gate.passed],
        scores={score.name: score for score in run.scores},
        yards=[yard_section(run, experiment, room) for experiment in yards],
        beside={
            e.name: _beside_paper(run, e)
            for e in yards
            if "angularity" in e.varied and REFERENCE in e.methods and not is_garden(e)
        },
        gardens={e.name: garden_tables(run, e) for e in yards if is_garden(e)},
        sweeps=[sweep_section(run, e, room) for e in of_rocks if e.sweep is not None],
        segmentations=[
            segmentation_section(run, e, room)
            for e in experiments
            if isinstance(e, SegmentationExperiment)
        ],
        shapes=[
            shapes_section(run, e, room) for e in experiments if isinstance(e, ShapesExperiment)
        ],
        tables=CONSISTENCY_TABLES,
        boards=leaderboards(run),
        command=command,
        minutes=f"{seconds:.0f} s",
        versions=versions(),
        seeds=seeds(run),
    )
    return html
