"""Sweeps: one experiment repeated with one key of its scene at several values."""

from typing import Annotated, Any

import msgspec
from msgspec import Meta, Struct

from synth.spec import SceneSpec
from validation.peers import Text

Value = bool | int | float | str | tuple[float, ...]


class Sweep(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A key of the scene, `camera.distance_m` say, and the values it takes in turn.

    The rocks are the same at every value, since the seeds are.
    """

    key: Annotated[str, Meta(pattern=r"^[a-z0-9_]+(\.[a-z0-9_]+)*$")]
    values: Annotated[tuple[Value, ...], Meta(min_length=2, max_length=20)]
    title: Text  # of the chart's axis, with its unit

    def __post_init__(self) -> None:
        """Ask for values that differ: the steps' names are made from them."""
        if len(set(self.steps)) < len(self.steps):
            raise ValueError(f"sweep: values: expected values that differ, found {self.values}")

    @property
    def steps(self) -> tuple[str, ...]:
        """The names of the steps: the values, a p for the point."""
        return tuple(_name(value) for value in self.values)

    def scene(self, scene: SceneSpec, step: str) -> SceneSpec:
        """Scene of one step.

        Raises:
            ValueError: the scene has no such key, or the value is not allowed there.
        """
        table: dict[str, Any] = msgspec.to_builtins(scene)
        *folders, last = self.key.split(".")
        place: Any = table
        for name in folders:
            place = place.get(name) if isinstance(place, dict) else None
        if not isinstance(place, dict) or last not in place:
            raise ValueError(f"sweep: key: expected a key of the scene, found {self.key!r}")
        place[last] = self.values[self.steps.index(step)]
        try:
            return msgspec.convert(table, SceneSpec)
        except msgspec.ValidationError as error:
            raise ValueError(f"sweep: {self.key}: {error}") from error


def _name(value: Value) -> str:
    if isinstance(value, tuple):
        return "-".join(_name(part) for part in value)
    if isinstance(value, bool | str):
        return str(value).lower()
    return f"{value:g}".replace(".", "p")
