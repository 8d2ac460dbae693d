"""Columns of the table of rocks: unit and description of each, and their JSON Schema."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from rockshape.measures import Measure
from rockshape.uncertainty import uncertainty_columns

JSON_SCHEMA = "https://json-schema.org/draft/2020-12/schema"


@dataclass(frozen=True)
class TableColumn:
    """Column of the table: its unit, empty for a pure number, and what it holds."""

    name: str
    unit: str
    description: str
    kind: str = "number"  # as JSON Schema has it
    may_lack: bool = False  # whether a value can be missing


def _lengths(unit: str, name: str) -> tuple[TableColumn, ...]:
    """Lengths of the outline in px or mm."""

    def column(what: str, told: str) -> TableColumn:
        return TableColumn(f"{what}_{unit}", unit, told, may_lack=True)

    return (
        column("major_axis", f"longer axis of the ellipse with the outline's area moments{name}"),
        column("minor_axis", f"shorter axis of that ellipse{name}"),
        column("feret_max", f"greatest distance of two parallel lines that hold the outline{name}"),
        column("feret_min", f"least such distance{name}"),
        column("equivalent_diameter", f"diameter of the circle of the outline's area{name}"),
    )


_ON_ROCK = ", by the pixel's side on the rock"
COLUMNS: Mapping[str, TableColumn] = MappingProxyType(
    {
        column.name: column
        for column in (
            TableColumn("image", "", "file of the image, in tables of several", "string"),
            TableColumn("rock", "", "its number, as the labels have it, else from 1", "integer"),
            TableColumn("row", "px", "row of the centroid of its pixels"),
            TableColumn("col", "px", "column of that centroid"),
            TableColumn("area_px", "px", "number of its pixels", "integer"),
            TableColumn("width_px", "px", "width of its upright box", "integer"),
            TableColumn("height_px", "px", "height of that box", "integer"),
            TableColumn("truncated", "", "whether it touches the border of the frame", "boolean"),
            TableColumn(
                "visible_fraction",
                "",
                "share of its ellipse in the frame and not behind a nearer rock",
            ),
            TableColumn("range_points", "", "range points that are measured", "integer"),
            TableColumn("flying_points", "", "its points in the air", "integer"),
            TableColumn("spike_points", "", "its other points far from its ellipsoid", "integer"),
            *(
                TableColumn(
                    f"axis_{axis}_m", "m", f"{which} half-axis of its ellipsoid", may_lack=True
                )
                for axis, which in (("a", "longest"), ("b", "intermediate"), ("c", "shortest"))
            ),
            TableColumn("flags", "", "what weakens its values or its view lacks", "string"),
            TableColumn("reason", "", "why values are missing", "string"),
            *_lengths("px", ""),
            *_lengths("mm", _ON_ROCK),
            TableColumn("outline_area_px2", "px²", "area within the outline", may_lack=True),
            TableColumn("outline_area_mm2", "mm²", f"that area{_ON_ROCK}", may_lack=True),
            TableColumn(
                "orientation_deg", "°", "from x to the major axis, clockwise as seen", may_lack=True
            ),
            TableColumn("box_row", "px", "first row of its upright box", "integer"),
            TableColumn("box_col", "px", "first column of that box", "integer"),
            TableColumn("pixel_mm", "mm", "side of a pixel on the rock", may_lack=True),
            TableColumn("perimeter_px", "px", "length of the outline", may_lack=True),
            TableColumn("aspect_ratio", "", "least over greatest Feret diameter", may_lack=True),
            TableColumn("circularity", "", "4π area over perimeter²", may_lack=True),
            TableColumn("solidity", "", "area over the convex hull's", may_lack=True),
            TableColumn("convexity", "", "the convex hull's perimeter over its own", may_lack=True),
            TableColumn("rectangularity", "", "area over the smallest rectangle's", may_lack=True),
            TableColumn("branch", "", "what found it: range, image or labels", "string"),
            TableColumn("outline_sd_px", "px", "standard deviation of its outline", may_lack=True),
            TableColumn(
                "outline_share", "", "share of its edge that no neighbour made", may_lack=True
            ),
        )
    }
)


def described(names: Sequence[str], measures: Sequence[Measure]) -> list[TableColumn]:
    """Descriptions of columns, of which some are measures'; an unknown one has none."""
    of_measures = {
        each.column: TableColumn(each.column, each.unit, each.title, may_lack=True)
        for each in measures
    }
    known = {**of_measures, **COLUMNS}
    known |= {each.name: each for one in list(known.values()) for each in _uncertain(one)}
    return [known.get(name) or TableColumn(name, "", "", may_lack=True) for name in names]


def _uncertain(column: TableColumn) -> Iterator[TableColumn]:
    """Columns of a value's uncertainty."""
    told = "standard deviation", "low end of the 90 % interval", "high end of it"
    for name, what in zip(uncertainty_columns(column.name), told, strict=True):
        yield TableColumn(name, column.unit, f"{what}: {column.description}", may_lack=True)


def json_schema(columns: Sequence[TableColumn]) -> dict[str, Any]:
    """JSON Schema of a table that is a list of an object a row."""
    properties = {
        column.name: {
            "type": [column.kind, "null"] if column.may_lack else column.kind,
            "description": column.description,
            **({"unit": column.unit} if column.unit else {}),
        }
        for column in columns
    }
    row = {"type": "object", "properties": properties, "required": list(properties)}
    return {"$schema": JSON_SCHEMA, "title": "Table of rocks", "type": "array", "items": row}
