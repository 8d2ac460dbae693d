"""Measures from elsewhere as a suite names them."""

from typing import Annotated, Literal

from msgspec import Meta, Struct, field

from rockshape.measures import METHODS

Name = Annotated[str, Meta(pattern="^[a-z][a-z0-9_-]*$")]
Text = Annotated[str, Meta(min_length=1)]
Trait = Literal["angularity", "roundness", "form"]


class MeasureSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A function or a command that measures the rocks of a label image; see docs/validation.md.

    Its columns are judged by what they rise with: `angularity` (1 − roundness), `roundness`
    (Wadell's) or `form` (from flat or oblong to equal-sided). It measures the rocks that the
    experiment's first method found, so that all are judged on the same masks.
    """

    name: Name  # stands for the method in the names of scores and in the records
    function: Text | None = None  # package.module:function
    command: Text | None = None  # with {labels} and {out}, and {image} and {range} if wanted
    rises_with: dict[str, Trait] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Ask for one way to measure, and for a name that no method has."""
        if (self.function is None) == (self.command is None):
            raise ValueError(f"measure {self.name!r}: expected a function or a command")
        if self.name in METHODS:
            raise ValueError(f"measure {self.name!r}: expected a name that no method has")
