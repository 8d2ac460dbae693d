"""Page of a measurement, `rockshape measure --report`: one HTML file that needs nothing else."""

import math
from importlib.resources import files

import jinja2
import numpy as np
from markupsafe import Markup

from rockshape.measurement import Measurement, to_frame
from rockshape.measures import Measure
from rockshape.report.charts import charts
from rockshape.report.drawing import drawn_rocks, picture_uri, scale_bar
from rockshape.report.meaning import meaning
from rockshape.report.verdict import verdict
from rockshape.table.columns import described

DIGITS = 4
CROWD = 60  # rocks beyond which numbers are not drawn until they are asked for
FILES = ("page.html", "page.css", "page.js")
_AT_FIRST = (
    "rock",
    "minor_axis_mm",
    "minor_axis_px",
    "area_px",
    "axis_a_m",
    "reason",
)  # columns shown


def render_page(title: str, measurement: Measurement) -> str:
    """HTML that shows an image with its rocks, charts and table."""
    frame = to_frame(measurement)
    names = list(frame.columns)
    columns = described(names, measurement.measures)
    first = {*_AT_FIRST, *(measure.column for measure in measurement.measures)}
    rows, cols = measurement.instances.shape
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    environment.filters |= {"number": _number, "short": lambda value: f"{value:.1f}"}
    folder = files("rockshape.report")
    texts = {
        name: (folder / name).read_text("utf-8") for name in ("page.html", "page.css", "page.js")
    }
    return environment.from_string(texts["page.html"]).render(
        title=title,
        style=Markup(texts["page.css"]),
        script=Markup(texts["page.js"]),
        verdict=verdict(measurement),
        method=measurement.method,
        rows=rows,
        cols=cols,
        picture=picture_uri(measurement.observation),
        drawn=list(drawn_rocks(measurement)),
        numbered=len(measurement) <= CROWD,
        bar=scale_bar(measurement),
        charts=Markup(charts(measurement)),
        columns=[
            (each, each.name in first and bool(frame[each.name].notna().any())) for each in columns
        ],
        cells=frame.to_dict(orient="records"),
        measures=[(each, meaning(each), _range(each)) for each in measurement.measures],
    )


def _number(value: object) -> str:
    """Cell of the table: four digits, nothing for NaN, words as they are."""
    if isinstance(value, bool | np.bool_):
        return "yes" if value else ""
    if isinstance(value, float):
        return "" if math.isnan(value) else f"{value:.{DIGITS}g}"
    return str(value)


def _range(measure: Measure) -> str:
    low, high = measure.value_range
    unit = f" {measure.unit}" if measure.unit else ""
    return f"from {low:g}{unit}" if math.isinf(high) else f"{low:g} to {high:g}{unit}"
