"""Overlay as SVG: the image with outlines, ellipses and numbers as lines that can be edited."""

from importlib.resources import files

from rockshape.measurement import Measurement
from rockshape.report.drawing import drawing

SUFFIX = ".svg"


def vector_overlay(measurement: Measurement) -> str:
    """SVG document in pixels of the image; each rock is a group `rock-NUMBER`."""
    import jinja2  # noqa: PLC0415 - for this picture alone
    from markupsafe import Markup  # noqa: PLC0415

    rows, cols = measurement.instances.shape
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    template = (files("rockshape.report") / "overlay.svg").read_text(encoding="utf-8")
    return environment.from_string(template).render(
        rows=rows,
        cols=cols,
        drawing=Markup(drawing(measurement)),
        thick=max(rows, cols) / 500,
    )
