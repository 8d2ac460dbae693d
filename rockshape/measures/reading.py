"""Reading of a measure: a number with its unit, or NaN with the reason."""

from collections.abc import Iterable
from enum import StrEnum
from typing import Self

NAN = float("nan")


class Reason(StrEnum):
    """Reason why a rock has no value of a measure."""

    NO_RANGE = "no range"
    NO_GRID = "no grid"  # points whose neighbours in the image are not known
    NO_CAMERA = "no camera"
    NO_GROUND = "no ground"
    TOO_SMALL = "too small"
    TRUNCATED = "truncated"
    CONTACTS = "contacts"
    DEGENERATE = "degenerate"
    NOT_RESOLVABLE = "not resolvable"


def listed(reasons: Iterable[tuple[str, Reason]]) -> str:
    """Reasons of columns that lack a value in a line, each once with its columns in brackets.

    `no range` stands alone: it holds for all columns that need range.
    """
    columns: dict[Reason, dict[str, None]] = {}
    for column, reason in reasons:
        columns.setdefault(reason, {})[column] = None
    return "; ".join(
        reason if reason is Reason.NO_RANGE else f"{reason} ({', '.join(names)})"
        for reason, names in columns.items()
    )


class Reading(float):
    """Value of a measure for one rock, a float; NaN where there is none, with the reason.

    sd and interval are NaN where the uncertainty was not estimated.
    """

    __slots__ = ("_interval", "_reason", "_sd", "_unit")

    def __new__(
        cls,
        value: float,
        unit: str = "",
        reason: Reason | None = None,
        sd: float = NAN,
        interval: tuple[float, float] = (NAN, NAN),
    ) -> Self:
        """Create a reading; interval is (low, high) of 90 % confidence."""
        reading = super().__new__(cls, value)
        reading._unit = unit
        reading._reason = reason
        reading._sd = sd
        reading._interval = interval
        return reading

    _unit: str
    _reason: Reason | None
    _sd: float
    _interval: tuple[float, float]

    @property
    def value(self) -> float:
        """Value as a plain float."""
        return float(self)

    @property
    def unit(self) -> str:
        """Unit of the value; empty for a pure number."""
        return self._unit

    @property
    def reason(self) -> Reason | None:
        """Reason why the value is NaN; None where there is a value."""
        return self._reason

    @property
    def sd(self) -> float:
        """Standard deviation, in the value's unit."""
        return self._sd

    @property
    def interval(self) -> tuple[float, float]:
        """Low and high end of the 90 % interval, in the value's unit."""
        return self._interval

    def __repr__(self) -> str:
        if self._reason is not None:
            return f"nan ({self._reason})"
        return f"{float(self):.4g} {self._unit}".rstrip()

    def __reduce__(self) -> tuple[object, ...]:
        values = (float(self), self._unit, self._reason, self._sd, self._interval)
        return type(self), values
