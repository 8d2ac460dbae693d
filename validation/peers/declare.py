"""What a function says of its columns."""

from collections.abc import Callable
from typing import ParamSpec, TypeVar

from validation.peers.spec import Trait

_P = ParamSpec("_P")
_T = TypeVar("_T")
ATTRIBUTE = "rises_with"


def rises_with(**traits: Trait) -> Callable[[Callable[_P, _T]], Callable[_P, _T]]:
    """Declare, as a decorator, what each column of a measure's function rises with."""

    def declared(function: Callable[_P, _T]) -> Callable[_P, _T]:
        setattr(function, ATTRIBUTE, dict(traits))
        return function

    return declared
