"""The page: one HTML file that needs nothing else."""

import math
from importlib.resources import files

from jinja2 import Environment, StrictUndefined
from markupsafe import Markup, escape

from validation.naming import REFERENCE, title_of
from validation.paper import CONSISTENCY_TABLES
from validation.report.charts import view_key
from validation.report.garden import garden_tables
from validation.report.leaderboard import leaderboards
from validation.report.paper import paper_values
from validation.report.provenance import seeds, versions
from validation.report.sections import segmentation_section, shapes_section, yard_section
from validation.report.sweeps import sweep_section
from validation.report.words import interval, number
from validation.run import Run
from validation.scores.agreement import STATISTICS
from validation.scores.garden import is_garden
from validation.suite import SegmentationExperiment, ShapesExperiment, YardExperiment


def _breakable(name: str) -> Markup:
    """Return a score's name that a line may break after a dot or an underscore."""
    return Markup(str(escape(name)).replace(".", ".<wbr>").replace("_", "_<wbr>"))


def _resource(name: str) -> str:
    return (files("validation.report") / name).read_text(encoding="utf-8")


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
    """Return the page of a run, its style and pictures inside."""
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {"number": number, "title_of": title_of, "breakable": _breakable}
    environment.globals |= {"interval": interval, "view_key": view_key, "isfinite": math.isfinite}
    rocks = [e for e in run.suite.experiments if isinstance(e, YardExperiment)]
    yards = [experiment for experiment in rocks if experiment.sweep is None]
    shapes = [e for e in run.suite.experiments if isinstance(e, ShapesExperiment)]
    html: str = environment.from_string(_resource("page.html")).render(
        run=run,
        style=Markup(_resource("page.css")),
        passed=sum(gate.passed for gate in run.gates),
        scores={score.name: score for score in run.scores},
        yards=[yard_section(run, experiment) for experiment in yards],
        beside={
            e.name: _beside_paper(run, e)
            for e in yards
            if "angularity" in e.varied and REFERENCE in e.methods and not is_garden(e)
        },
        gardens={e.name: garden_tables(run, e) for e in yards if is_garden(e)},
        sweeps=[sweep_section(run, e) for e in rocks if e.sweep is not None],
        segmentations=[
            segmentation_section(run, e)
            for e in run.suite.experiments
            if isinstance(e, SegmentationExperiment)
        ],
        shapes=[shapes_section(run, experiment) for experiment in shapes],
        tables=CONSISTENCY_TABLES,
        boards=leaderboards(run),
        command=command,
        minutes=f"{seconds:.0f} s",
        versions=versions(),
        seeds=seeds(run),
    )
    return html
