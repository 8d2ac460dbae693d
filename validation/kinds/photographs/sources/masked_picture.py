"""Masked picture: a picture with what is known of its rocks; and the base of its sources."""

from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from validation.arrays import Floats, Labels


@dataclass(frozen=True, eq=False)
class TrueRocks:
    """What a mask tells of the rocks in a picture."""

    rock: NDArray[np.bool_]  # (rows, cols), whether a pixel is rock
    labels: Labels | None  # (rows, cols), rocks from 1 on; None: they are not told apart
    judged: NDArray[np.bool_]  # (rows, cols); what is not has a label but is no rock that counts


@dataclass(frozen=True, eq=False)
class MaskedPicture:
    """Picture with known rocks."""

    image: NDArray[np.uint8]  # (rows, cols) grey, or (rows, cols, 3): red, green, blue
    truth: TrueRocks
    visible_fraction: Floats | None = None  # (n + 1,), by the label; None: not known


class PictureSource(
    Struct, frozen=True, forbid_unknown_fields=True, kw_only=True, tag_field="from"
):
    """Base of the sources: the table `pictures` of an experiment."""

    @property
    def count(self) -> int:
        """Number of pictures."""
        raise NotImplementedError

    @property
    def has_instances(self) -> bool:
        """Whether rocks are told apart in any picture."""
        raise NotImplementedError

    def name(self, number: int) -> str:
        """Name of a picture for reading."""
        raise NotImplementedError

    def credits(self) -> tuple[str, ...]:
        """Whose pictures they are, a line each; none for made ones."""
        return ()

    def picture(self, seed: int, number: int, /) -> MaskedPicture:
        """Picture of a number, read or made."""
        raise NotImplementedError

    def dependencies(self, number: int, /) -> dict[str, Any]:
        """Everything that a picture depends on, as plain values."""
        raise NotImplementedError

    def first(self, count: int) -> Self:
        """Source with at most so many pictures."""
        raise NotImplementedError

    def check(self) -> None:
        """Check what only registries and files know.

        Raises:
            InputError: a picture that does not exist.
        """
