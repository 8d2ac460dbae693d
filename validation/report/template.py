"""Templates of the page: those shared by all kinds, and each kind's own."""

import math
from functools import cache

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from validation.report.charts import span, view_key
from validation.report.format import interval, number
from validation.scores.titles import title_of

_SHARED = "validation.report"


def _breakable(name: str) -> Markup:
    """Score's name that a line may break after a dot or an underscore."""
    return Markup(str(escape(name)).replace(".", ".<wbr>").replace("_", "_<wbr>"))


@cache
def _environment(packages: tuple[str, ...]) -> Environment:
    environment = Environment(
        loader=ChoiceLoader([PackageLoader(each) for each in (*packages, _SHARED)]),
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
    return environment


def render(name: str, *packages: str, **values: object) -> Markup:
    """Template of the first package that has it in its folder `templates`.

    After those named come the templates that all kinds share.
    """
    return Markup(_environment(packages).get_template(name).render(**values))
