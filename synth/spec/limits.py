"""Limits of the numbers in a specification."""

from typing import Annotated

from msgspec import Meta, Struct

Positive = Annotated[float, Meta(gt=0, le=1000)]
Degrees = Annotated[float, Meta(ge=-360, le=360)]
Fraction = Annotated[float, Meta(ge=0, le=1)]
Ratio = Annotated[float, Meta(gt=0, le=1)]
PositiveRange = tuple[Positive, Positive]
RatioRange = tuple[Ratio, Ratio]
AxisRatio = Annotated[float, Meta(ge=0.01, le=1)]  # thinner bodies have no volume in float32
AxisRatioRange = tuple[AxisRatio, AxisRatio]
MAX_COUNT = 500  # rocks in a scene, views of it
Count = Annotated[int, Meta(ge=1, le=MAX_COUNT)]


def check_range(name: str, limits: tuple[float, float]) -> None:
    """Raise ValueError unless limits are in rising order."""
    low, high = limits
    if not low <= high:
        raise ValueError(f"{name}: expected [low, high] with low <= high, found [{low}, {high}]")


def check_ranges(table: Struct, *names: str) -> None:
    """Raise ValueError unless those ranges of a table are in rising order."""
    for name in names:
        check_range(name, getattr(table, name))
