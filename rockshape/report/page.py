"""Page of measured images, `rockshape measure --report`: one HTML file that needs nothing else."""

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import jinja2
import numpy as np
from markupsafe import Markup

from rockshape.measurement import Measurement, to_frame
from rockshape.measures import Measure
from rockshape.report.charts import charts
from rockshape.report.meaning import meaning
from rockshape.report.section import Section, section_of
from rockshape.report.verdict import Tally, verdict
from rockshape.table.columns import described

if TYPE_CHECKING:
    import pandas as pd

DIGITS = 4
CROWD = 60  # rocks beyond which numbers are not drawn until they are asked for
FILES = ("page.html", "page.css", "page.js")
_AT_FIRST = (
    "image",
    "rock",
    "minor_axis_mm",
    "minor_axis_px",
    "area_px",
    "axis_a_m",
    "flags",
    "reason",
)  # columns shown
_IN_PIXELS = {"minor_axis_px", "area_px"}  # not where sizes are known in mm


@dataclass(frozen=True, eq=False)
class PageContent:
    """What a page shows; sections and rows are gone through once."""

    title: str
    method: str  # its name
    measures: tuple[Measure, ...]
    tally: Tally  # of all images
    values: "pd.DataFrame"  # the columns that charts and verdict are made of, of all rocks
    columns: Sequence[str]  # of the table
    filled: Collection[str]  # those of them that have a value
    sections: Iterable[Section]
    rows: Iterable[tuple[str, Mapping[Any, Any]]]  # key of a rock's drawing, its row
    left_out: str = ""  # what is not shown, in words


def render_page(title: str, measurement: Measurement) -> str:
    """HTML that shows an image with its rocks, charts and table."""
    frame = to_frame(measurement)
    section = section_of(title, measurement)
    content = PageContent(
        title=title,
        method=measurement.method,
        measures=measurement.measures,
        tally=section.tally,
        values=frame,
        columns=list(frame.columns),
        filled=frame.columns[frame.notna().any()].tolist(),
        sections=[section],
        rows=((str(row["rock"]), row) for row in frame.to_dict(orient="records")),
    )
    return "".join(page_parts(content))


def page_parts(content: PageContent) -> Iterator[str]:
    """Yield the HTML of a page piece by piece."""
    columns = described(content.columns, content.measures)
    first = {*_AT_FIRST, *(measure.column for measure in content.measures)}
    if "minor_axis_mm" in content.filled:
        first -= _IN_PIXELS
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    environment.filters["number"] = _number
    folder = files("rockshape.report")
    texts = {name: (folder / name).read_text("utf-8") for name in FILES}
    many = content.tally.images > 1
    return environment.from_string(texts["page.html"]).generate(
        title=content.title,
        style=Markup(texts["page.css"]),
        script=Markup(texts["page.js"]),
        verdict=verdict(content.tally, content.values),
        method=content.method,
        many=many,
        sections=content.sections,
        numbered=content.tally.rocks <= CROWD and not many,
        charts=Markup(charts(content.values, content.measures)),
        columns=[(each, each.name in first and each.name in content.filled) for each in columns],
        rows=content.rows,
        left_out=content.left_out,
        measures=[(each, meaning(each), _range(each)) for each in content.measures],
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
