"""Overlay as SVG: the image with outlines, ellipses and numbers as lines that can be edited."""

from importlib.resources import files

from rockshape.measurement import Measurement
from rockshape.report.drawing import drawn_rocks, picture_uri, scale_bar

SUFFIX = ".svg"


def vector_overlay(measurement: Measurement) -> str:
    """SVG document in pixels of the image; each rock is a group `rock-NUMBER`."""
    import jinja2  # noqa: PLC0415 - for this picture alone

    rows, cols = measurement.instances.shape
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    environment.filters["short"] = lambda value: f"{value:.1f}"
    template = (files("rockshape.report") / "overlay.svg").read_text(encoding="utf-8")
    return environment.from_string(template).render(
        rows=rows,
        cols=cols,
        picture=picture_uri(measurement.observation),
        drawn=list(drawn_rocks(measurement)),
        bar=scale_bar(measurement),
        thick=max(rows, cols) / 500,
    )
