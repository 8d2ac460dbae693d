"""Pebbles experiment: masks of real pebbles, measured at a part of their resolution."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Any, Literal

from msgspec import Meta

from rockshape.method import BUILT_IN
from validation.errors import InputError
from validation.kinds.photographs.sources.experiment import PicturesExperiment
from validation.kinds.photographs.sources.files import Files
from validation.kinds.photographs.sources.shipped import Shipped
from validation.suite.experiment import Methods

Resolution = Literal["half", "third"]
FACTORS: Mapping[Resolution, int] = MappingProxyType({"half": 2, "third": 3})


class PebblesExperiment(PicturesExperiment, frozen=True, kw_only=True, tag="pebbles"):
    """Real pebbles at their full resolution and with larger pixels, each by itself.

    Unit i is picture i of the source. A pebble counts where it has so many pixels as a disk of the
    least width and is wholly in the frame. The truth of a value is the same measure's at full
    resolution.
    """

    takes_measures = True

    methods: Methods = BUILT_IN
    pictures: Shipped | Files
    series: Annotated[tuple[Resolution, ...], Meta(min_length=1)] = ("half", "third")
    min_width_px: Annotated[float, Meta(ge=12)] = 36.0  # equivalent diameter, full resolution

    def dependencies(self, _series: str, scene: int, /) -> dict[str, Any]:
        """What a unit depends on."""
        plain = self.plain(without=("title", "pictures"))
        return plain | {"picture": self.pictures.dependencies(scene)}

    def check(self) -> None:
        """Check that methods and pictures are known, and that the masks tell rocks apart.

        Raises:
            InputError: one that is not, or a mask without rocks.
        """
        super().check()
        if not self.pictures.has_instances:
            raise InputError("pictures: expected masks that tell rocks apart, found none")
