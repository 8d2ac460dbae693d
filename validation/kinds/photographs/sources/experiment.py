"""Pictures experiment: an experiment whose units are pictures of a source."""

from typing import Annotated, Self

import msgspec
from msgspec import Meta

from validation.kinds.photographs.sources.beds import Beds
from validation.kinds.photographs.sources.files import Files
from validation.kinds.photographs.sources.shipped import Shipped
from validation.suite.experiment import Experiment


class PicturesExperiment(Experiment, frozen=True, kw_only=True):
    """Base of the specs whose unit i is picture i of the source, for all series at once."""

    series: Annotated[tuple[str, ...], Meta(min_length=1)]
    pictures: Beds | Shipped | Files

    def __post_init__(self) -> None:
        """Ask for each series once."""
        super().__post_init__()
        if len(set(self.series)) < len(self.series):
            raise ValueError(f"series: expected each once, found {', '.join(self.series)}")

    @property
    def units(self) -> tuple[tuple[str, int], ...]:
        """Each picture."""
        return tuple(("", number) for number in range(self.pictures.count))

    def first(self, scenes: int, /) -> Self:
        """Spec with at most so many pictures."""
        return msgspec.structs.replace(self, pictures=self.pictures.first(scenes))

    def check(self) -> None:
        """Check that methods and pictures are known.

        Raises:
            InputError: one that is not.
        """
        super().check()
        self.pictures.check()
