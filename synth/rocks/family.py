"""Rock family record: how its rocks are drawn, and what a spec may ask of it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, TypeVar

import msgspec
import numpy as np
from msgspec import Struct, UnsetType

from synth.arrays import Floats
from synth.rocks.record import RockModel
from synth.spec.registry import options_of
from synth.spec.rocks import FAMILIES, RocksSpec

Make = Callable[[], RockModel]
Plan = Callable[[RocksSpec, Floats, np.random.Generator], Make]
Draw = Callable[[RocksSpec, Floats, np.random.Generator], RockModel]
Grade = Callable[[RocksSpec, Sequence[tuple[Floats, float]], np.random.Generator], list[RockModel]]


@dataclass(frozen=True, eq=False)
class Family:
    """Rock family.

    `draw` returns one rock from the spec, the half-axes (3,) wanted, a >= b >= c in metres, and
    random numbers. `plan`, in place of it, draws all random numbers and returns what makes the rock
    without any: it is pickled, so that another process may call it. `grade` returns one form in
    several pairs of half-axes and rounding (edge radius over inradius), in their order: the series
    `graded` and `sphericity` need it.
    A family with `members` has none of them: its rocks are of its members in turn.
    """

    name: str
    title: str  # one line, for lists
    draw: Draw | None = None
    plan: Plan | None = None
    grade: Grade | None = None
    members: tuple[str, ...] = ()
    truth: Literal["exact", "mesh"] = "mesh"  # closed forms; or the mesh is the body
    always_rough: bool = False  # has relief whether or not the spec asks for it
    extended: bool = False  # its rocks have the further truth of [truth] without being asked
    limits: Callable[[RocksSpec], None] | None = None  # raises ValueError, see `check`
    options: type[Struct] | None = None  # of the table [rocks.options]

    @property
    def series(self) -> tuple[str, ...]:
        """The series that it can be graded in."""
        graded = () if self.grade is None else ("graded", "sphericity")
        return (*graded, *(() if self.members else ("relief",)), "random")

    def check(self, spec: RocksSpec) -> None:
        """Raise ValueError, its text beginning with the key, where the spec lacks something."""
        if self.limits is not None:
            self.limits(spec)


def find_family(name: str) -> Family:
    """Rock family of a name.

    Raises:
        SpecError: no family has the name, or what has it is no `Family`.
    """
    return FAMILIES.find_kind(name, Family)


def register_family(family: Family) -> Family:
    """Add a rock family to this process and to the worker processes that it starts.

    Raises:
        SpecError: the name is taken by a family of the package or of an entry point.
    """
    FAMILIES.register(family)
    return family


Options = TypeVar("Options", bound=Struct)


def own_options(spec: RocksSpec, kind: type[Options]) -> Options:
    """Options of the struct `kind` that the spec, which has been checked, holds."""
    return msgspec.convert({} if isinstance(spec.options, UnsetType) else spec.options, kind)


def family_options(spec: RocksSpec) -> Struct | None:
    """Options of the spec's family, of its own struct; None where it has none.

    Raises:
        SpecError: a key or value that the family does not allow.
    """
    return options_of("family", find_family(spec.family), spec.options)
