"""Names of measures for reading, from the registry of the measures themselves."""

from rockshape.method import find_method, measure_of, methods
from validation.scores.expectations import Claim

REFERENCE = "paper"  # the method whose name scores and titles leave out


def title_of(column: str) -> str:
    """Title of a measure's column, or the column itself where no measure has it."""
    measure = measure_of(column)
    return column if measure is None else measure.title


def title_of_claim(claim: Claim) -> str:
    """Title of the claim's column, with its method unless that is the paper's."""
    own = methods()[claim.method].measures if claim.method in methods() else ()
    titles = [measure.title for measure in own if measure.column == claim.measure]
    title = titles[0] if titles else claim.measure
    return title if claim.method == REFERENCE else f"{title} ({claim.method})"


def unit_of(column: str) -> str:
    """Unit of a measure's column, empty for a pure number."""
    measure = measure_of(column)
    return "" if measure is None else measure.unit


def column_of(method: str, paper_column: str) -> str:
    """Method's column of the measure that the paper's method calls so."""
    titles = {measure.column: measure.title for measure in find_method(REFERENCE).measures}
    return next(m.column for m in find_method(method).measures if m.title == titles[paper_column])
