"""Names of measures for reading, from the registry of the measures themselves."""

from rockshape.measures import METHODS


def title_of(column: str) -> str:
    """Return the title of a measure's column, or the column itself where no measure has it."""
    for measures in METHODS.values():
        for measure in measures:
            if measure.column == column:
                return measure.title
    return column


def unit_of(column: str) -> str:
    """Return the unit of a measure's column, empty for a pure number."""
    for measures in METHODS.values():
        for measure in measures:
            if measure.column == column:
                return measure.unit
    return ""
