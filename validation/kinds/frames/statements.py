"""Statements of the paper's section 4 on the named rocks of figures 11 and 12.

Each is an order of the rocks by one measure; rocks that the text does not part share a place.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Statement:
    """Order of a frame's named rocks by one measure, from least to most."""

    figure: int
    measure: str  # column of the method `paper`
    rising: tuple[tuple[str, ...], ...]


_FLAT_TOPS = ("Flat Top", "Little Flat Top")
STATEMENTS = (
    Statement(11, "angularity_2d_deg", (("Stimpy",), _FLAT_TOPS)),
    Statement(11, "ellipse_error_px2", (("Stimpy",), ("Flat Top",), ("Little Flat Top",))),
    Statement(11, "axis_ratio", (("Little Flat Top",), ("Flat Top",), ("Stimpy",))),
    Statement(11, "sphericity_2d", (("Little Flat Top",), ("Flat Top",), ("Stimpy",))),
    Statement(11, "angularity_3d_per_m", (_FLAT_TOPS, ("Stimpy",))),
    Statement(11, "sphericity_3d", (_FLAT_TOPS, ("Stimpy",))),
    Statement(12, "angularity_2d_deg", (("Bamm-Bamm",), ("Flute Top",))),
    Statement(12, "ellipse_error_px2", (("Bamm-Bamm",), ("Flute Top",))),
    Statement(12, "axis_ratio", (("Flute Top",), ("Bamm-Bamm",))),
    Statement(12, "sphericity_2d", (("Flute Top",), ("Bamm-Bamm",))),
    Statement(12, "angularity_3d_per_m", (("Flute Top",), ("Bamm-Bamm",))),
    Statement(12, "sphericity_3d", (("Flute Top",), ("Bamm-Bamm",))),
)


def places(figure: int, measure: str) -> dict[str, float]:
    """Place of each named rock of a figure by a measure, 1 for the least; empty where none said."""
    return {
        rock: float(place)
        for statement in STATEMENTS
        if (statement.figure, statement.measure) == (figure, measure)
        for place, rocks in enumerate(statement.rising, start=1)
        for rock in rocks
    }
