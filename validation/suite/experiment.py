"""Experiment: the table of a suite from which its units, scores and page section follow."""

from collections.abc import Sequence
from typing import Annotated, Any, ClassVar, Self

import msgspec
from msgspec import Meta, Struct

from rockshape.method import methods
from synth.spec.wording import expected_one_of
from validation.errors import InputError
from validation.peers import Name, Text

Seed = Annotated[int, Meta(ge=0, lt=2**32)]
Methods = Annotated[tuple[str, ...], Meta(min_length=1)]  # the first one's outlines are shown


class Experiment(
    Struct,
    frozen=True,
    forbid_unknown_fields=True,
    kw_only=True,
    tag_field="kind",
    tag="experiment",
):
    """Base of every kind's spec. A subclass has the kind's name as its tag and says its units.

    Unit number `scene` of a series is a function of the spec, of the series and of that number
    alone; its random seed is `seed` + scene.
    """

    takes_measures: ClassVar[bool] = False  # whether measures from elsewhere are judged on it

    name: Name
    title: Text
    seed: Seed

    def __post_init__(self) -> None:
        """Ask for methods, each once, where rocks are measured."""
        if len(set(self.methods)) < max(len(self.methods), int(self.is_measured)):
            raise ValueError(
                f"methods: expected some, each once, found {', '.join(self.methods) or 'none'}"
            )

    @property
    def is_measured(self) -> bool:
        """Whether its rocks are measured: whether `methods` is a key of its kind."""
        return "methods" in self.__struct_fields__

    @property
    def methods(self) -> tuple[str, ...]:
        """Names of the methods that measure its rocks; a measured kind has a key in its place."""
        return ()

    @property
    def units(self) -> tuple[tuple[str, int], ...]:
        """(series, scene number) of each unit, in the order of the records."""
        raise NotImplementedError(f"{type(self).__name__}.units")

    def dependencies(self, series: str, scene: int, /) -> dict[str, Any]:  # noqa: ARG002
        """Everything in the spec that the result of a unit depends on, as plain values."""
        return self.plain(without=("title",))

    def settled(self) -> Self:
        """Spec with what depends on the machine, such as the renderer, chosen."""
        return self

    def measured_by(self, methods: tuple[str, ...]) -> Self:
        """Spec measured by these methods; itself where it measures nothing."""
        return msgspec.structs.replace(self, methods=methods) if self.is_measured else self

    def first(self, scenes: int, /) -> Self:  # noqa: ARG002
        """Spec with at most so many scenes, where a scene takes time."""
        return self

    def check(self) -> None:
        """Check what only the registries know, such as the names of methods.

        Raises:
            InputError: a name that no registry has.
        """
        for method in self.methods:
            if method not in methods():
                raise InputError(f"methods: {expected_one_of(method, methods())}")

    def plain(self, *, without: Sequence[str]) -> dict[str, Any]:
        """Spec as plain values but for some of its keys."""
        spec: dict[str, Any] = msgspec.to_builtins(self)
        return {key: value for key, value in spec.items() if key not in without}
