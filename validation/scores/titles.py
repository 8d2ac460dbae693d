"""Names of measures for reading, from the registry of the measures themselves."""

from rockshape.measures import METHODS
from validation.scores.expectations import Claim

REFERENCE = "paper"  # the method whose name scores and titles leave out


def title_of(column: str) -> str:
    """Return the title of a measure's column, or the column itself where no measure has it."""
    for measures in METHODS.values():
        for measure in measures:
            if measure.column == column:
                return measure.title
    return column


def title_of_claim(claim: Claim) -> str:
    """Return the title of the claim's column, with its method unless that is the paper's."""
    own = METHODS.get(claim.method, ())
    titles = [measure.title for measure in own if measure.column == claim.measure]
    title = titles[0] if titles else claim.measure
    return title if claim.method == REFERENCE else f"{title} ({claim.method})"


def unit_of(column: str) -> str:
    """Return the unit of a measure's column, empty for a pure number."""
    for measures in METHODS.values():
        for measure in measures:
            if measure.column == column:
                return measure.unit
    return ""
