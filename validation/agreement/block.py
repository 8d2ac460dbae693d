"""The same rocks measured from several views."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.errors import InputError


@dataclass(frozen=True, eq=False)
class Block:
    """One measure of one scene.

    Raises:
        InputError: the shapes do not belong together.
    """

    values: NDArray[np.float64]  # (views, rocks), NaN where a rock was not measured
    truth: NDArray[np.float64]  # (rocks,), a greater truth asks for a greater value

    def __post_init__(self) -> None:
        if self.values.ndim != 2 or self.truth.shape != self.values.shape[1:]:
            raise InputError(
                "block: expected values (views, rocks) and truth (rocks,), "
                f"found {self.values.shape} and {self.truth.shape}"
            )

    @property
    def rocks(self) -> int:
        """The number of rocks."""
        return int(self.truth.size)

    def complete(self) -> NDArray[np.float64]:
        """Return the values (views, complete rocks) of the rocks measured in every view."""
        return self.values[:, np.isfinite(self.values).all(axis=0)]
