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
    truth: NDArray[np.float64]  # (rocks,), or (views, rocks) where it differs from view to view

    def __post_init__(self) -> None:
        if self.values.ndim != 2 or self.truth.shape not in (
            self.values.shape,
            self.values.shape[1:],
        ):
            raise InputError(
                "block: expected values (views, rocks) and truth (rocks,) or (views, rocks), "
                f"found {self.values.shape} and {self.truth.shape}"
            )

    @property
    def rocks(self) -> int:
        """The number of rocks."""
        return int(self.values.shape[1])

    @property
    def view_truth(self) -> NDArray[np.float64]:
        """The truth in each view, (views, rocks); a greater truth asks for a greater value."""
        return np.broadcast_to(self.truth, self.values.shape)

    def complete(self) -> NDArray[np.float64]:
        """Values (views, complete rocks) of the rocks measured in every view."""
        return self.values[:, np.isfinite(self.values).all(axis=0)]
