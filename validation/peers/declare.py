"""Expected traits that a measure's function declares for its columns."""

from collections.abc import Callable, Mapping
from typing import Literal, ParamSpec, TypeVar

Trait = Literal["angularity", "roundness", "roughness", "form"]
_P = ParamSpec("_P")
_T = TypeVar("_T")
_ATTRIBUTE = "expected_trait"
VALUE = "value"  # column of a function that returns bare numbers


def expected_trait(
    value: Trait | None = None, /, **traits: Trait
) -> Callable[[Callable[_P, _T]], Callable[_P, _T]]:
    """Decorator that declares the trait each column rises with, monotonically.

    `@expected_trait("roundness")` is for a function that returns bare numbers,
    `@expected_trait(solidity="roundness", axis_ratio="form")` for one that returns columns.
    """
    declared: dict[str, Trait] = {**traits} if value is None else {VALUE: value, **traits}

    def decorate(function: Callable[_P, _T]) -> Callable[_P, _T]:
        setattr(function, _ATTRIBUTE, declared)
        return function

    return decorate


rises_with = expected_trait


def declared_traits(function: Callable[..., object]) -> Mapping[str, Trait]:
    """Traits by column that a function declares; empty where it declares none."""
    found: Mapping[str, Trait] = getattr(function, _ATTRIBUTE, {})
    return found if isinstance(found, Mapping) else {}
