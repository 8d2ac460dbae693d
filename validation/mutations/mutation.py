"""What an error changes: the value of a measure, what is seen, the table, or the records."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from rockshape.observation import Observation
from rockshape.rock.view import RockView

Evaluate = Callable[[RockView], float]  # a measure's value of a rock


@dataclass(frozen=True)
class Mutation:
    """One error, of the kind that a change of code or of data brings in unseen.

    Only what is given is changed, and only in the experiments named. What is measured anew on rocks
    is tried on the first scene of each experiment alone, as it takes time.
    """

    name: str
    what: str  # in words
    experiments: tuple[str, ...]
    evaluate: Mapping[str, Evaluate] = field(default_factory=dict)  # by column
    patch: tuple[type, str, Callable[..., object]] | None = None  # class, method, replacement
    observe: Callable[[Observation], Observation] | None = None
    labels: Callable[[NDArray[np.int32]], NDArray[np.int32]] | None = None
    table: Callable[[pd.DataFrame], pd.DataFrame] | None = None
    records: Callable[[pd.DataFrame], pd.DataFrame] | None = None

    @property
    def finds_anew(self) -> bool:
        """Whether rocks are found or masks measured anew."""
        return not (self.patch is None and self.observe is None and self.labels is None)

    @property
    def measures_anew(self) -> bool:
        """Whether anything is measured anew, and not only a table changed."""
        return self.finds_anew or bool(self.evaluate)
