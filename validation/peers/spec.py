"""Specification of a measure from elsewhere, as a suite has it."""

from collections.abc import Mapping
from typing import Annotated, Any

from msgspec import Meta, Struct, field

from rockshape.method import methods
from validation.peers.declare import Trait

Name = Annotated[str, Meta(pattern="^[a-z][a-z0-9_-]*$")]
Text = Annotated[str, Meta(min_length=1)]


class MeasureSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A function or a command that measures the rocks of a label image; see docs/own-measures.md.

    Its columns are judged by the trait that they rise with: `angularity` (1 − roundness),
    `roundness` (Wadell's) or `form` (from flat or elongated to equant). It measures the rocks that
    the experiment's first method found, so that all measures are judged on the same masks.
    """

    name: Name  # stands for the method in the names of scores and in the records
    function: Text | None = None  # package.module:function
    command: Text | None = None  # with {labels} and {out}, and {image} and {range} if wanted
    expected_trait: dict[str, Trait] = field(default_factory=dict)  # by column

    def __post_init__(self) -> None:
        """Check that there is one way to measure, and that no method has the name."""
        if (self.function is None) == (self.command is None):
            raise ValueError(f"measure {self.name!r}: expected a function or a command")
        if self.name in methods():
            raise ValueError(f"measure {self.name!r}: expected a name that no method has")


def normalise_measures(table: Mapping[str, Any]) -> dict[str, Any]:
    """Table of a suite whose `[[measure]]` tables have their shorthands written out.

    `rises_with` is an alias of `expected_trait`, and `expected_trait = "roundness"` is that of the
    column `value`, of a function that returns bare numbers.
    """
    measures = table.get("measure")
    if not isinstance(measures, list):
        return dict(table)
    return {**table, "measure": [_normalised(each) for each in measures]}


def _normalised(measure: object) -> object:
    if not isinstance(measure, dict):
        return measure
    written = dict(measure)
    if "rises_with" in written and "expected_trait" not in written:
        written["expected_trait"] = written.pop("rises_with")
    if isinstance(written.get("expected_trait"), str):
        written["expected_trait"] = {"value": written["expected_trait"]}
    return written
