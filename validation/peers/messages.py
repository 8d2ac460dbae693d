"""Messages between this process and the one that runs a measure's function."""

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from validation.peers.view_input import Seen

MAX_BYTES = 2**30  # of a message
REPLY_BYTES = 2**26  # of a reply: one number a rock and column


class Array(Struct, frozen=True):
    """Array as bytes."""

    dtype: str
    shape: tuple[int, ...]
    data: bytes

    @classmethod
    def of(cls, values: NDArray[np.generic]) -> "Array":
        """Message of an array."""
        return cls(values.dtype.str, values.shape, np.ascontiguousarray(values).tobytes())

    def array(self) -> NDArray[np.generic]:
        """Read-only array of the message."""
        return np.frombuffer(self.data, self.dtype).reshape(self.shape)


class Description(Struct, frozen=True, kw_only=True):
    """Function as its module defines it, or why it cannot be used."""

    traits: dict[str, str] = {}  # declared, by column
    source: str = ""  # file of its module
    error: str = ""


class Request(Struct, frozen=True, kw_only=True):
    """View to be measured."""

    image: Array
    labels: Array
    points_m: Array | None
    outlines_px: dict[int, Array]
    where: str  # begins the message of an error

    @classmethod
    def of(cls, seen: Seen, *, where: str) -> "Request":
        """Message of a view."""
        points = None if seen.points_m is None else Array.of(seen.points_m)
        return cls(
            image=Array.of(seen.image),
            labels=Array.of(seen.labels),
            points_m=points,
            outlines_px={number: Array.of(each) for number, each in seen.outlines_px.items()},
            where=where,
        )

    def seen(self) -> Seen:
        """View with read-only arrays."""
        points = None if self.points_m is None else self.points_m.array().astype(np.float64)
        return Seen(
            self.image.array().astype(np.float32, copy=False),
            self.labels.array().astype(np.int32, copy=False),
            points,
            {n: each.array().astype(np.float64) for n, each in self.outlines_px.items()},
        ).read_only()


class Reply(Struct, frozen=True, kw_only=True):
    """Columns of one number a rock, in the rising order of the labels, or what went wrong."""

    columns: dict[str, list[float]] = {}
    error: str = ""
